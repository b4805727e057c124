"""Equations as MathML, which browsers draw themselves: a page needs neither network nor script."""

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer."""
    app.add_html_math_renderer("mathml", (_inline, None), (_displayed, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _inline(writer: nodes.NodeVisitor, node: nodes.Element) -> None:
    writer.body.append(latex2mathml.tex2mathml(node.astext(), as_block=False))
    raise nodes.SkipNode


def _displayed(writer: nodes.NodeVisitor, node: nodes.Element) -> None:
    source = node.astext().strip()
    if r"\\" in source and r"\begin" not in source:
        source = rf"\begin{{aligned}}{source}\end{{aligned}}"
    writer.body.append(f'<div class="equation">{latex2mathml.tex2mathml(source, as_block=True)}</div>')
    raise nodes.SkipNode
