"""Equations as MathML, which browsers draw themselves: a page needs neither network nor script."""

import re

from docutils import nodes
from docutils.utils.math import latex2mathml
from sphinx.application import Sphinx


def setup(app: Sphinx) -> dict[str, bool]:
    """Register the renderer."""
    app.add_html_math_renderer("mathml", (_inline, None), (_displayed, None))
    return {"parallel_read_safe": True, "parallel_write_safe": True}


def _inline(writer: nodes.NodeVisitor, node: nodes.Element) -> None:
    writer.body.append(_mathml(node.astext(), block=False))
    raise nodes.SkipNode


def _displayed(writer: nodes.NodeVisitor, node: nodes.Element) -> None:
    source = node.astext().strip()
    if r"\\" in source and r"\begin" not in source:
        source = rf"\begin{{aligned}}{source}\end{{aligned}}"
    writer.body.append(f'<div class="equation">{_mathml(source, block=True)}</div>')
    raise nodes.SkipNode


_ACCENTED = re.compile(
    r"<munderover>\s*(<mi[^>]*>[^<]*</mi>)\s*(<m(i|n|row)>.*?</m\3>)\s*"
    r'(<mo stretchy="false">[˙ˆ¯]</mo>)\s*</munderover>',
    re.DOTALL,
)
"""What the converter makes of an accented letter with an index: the index below the letter."""


def _mathml(source: str, *, block: bool) -> str:
    made = latex2mathml.tex2mathml(source, as_block=block)
    return _ACCENTED.sub(r'<msub><mover accent="true">\1\4</mover>\2</msub>', made)
