"""Links from a page to a file outside docs/: shown as its path in the checkout."""

from pathlib import Path

from docutils import nodes
from sphinx.addnodes import download_reference, pending_xref
from sphinx.application import Sphinx
from sphinx.transforms import SphinxTransform


class _Outside(SphinxTransform):
    default_priority = 5

    def apply(self) -> None:
        """Replace each such link by its text and the path."""
        root = Path(self.app.srcdir).parent
        page = Path(self.env.doc2path(self.env.docname)).parent
        for link in [*self.document.findall(pending_xref), *self.document.findall(download_reference)]:
            target = (page / link.get("reftarget", "").split("#")[0]).resolve()
            if link.get("refdomain") == "doc":  # a page by its name, without the ending
                target = target.with_name(f"{target.name}.md")
            if not target.is_file() or target.is_relative_to(self.app.srcdir):
                continue
            shown = target.relative_to(root).as_posix()
            text = link.astext()
            replacement: list[nodes.Node] = [nodes.literal(text=shown)]
            if text not in (shown, target.name):
                replacement = [nodes.Text(f"{text} ("), *replacement, nodes.Text(")")]
            link.replace_self(replacement)


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the transform."""
    app.add_transform(_Outside)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
