"""Figures: made in the house style, saved as files, put into pages as SVG."""

from __future__ import annotations

import io
import re
from contextlib import contextmanager
from html import escape
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import matplotlib as mpl
import numpy as np
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.ticker import LogFormatter

from probation._files import write_whole
from probation._text import printable, printable_lines
from probation.errors import InputError
from probation.report.style import COLOURS, MATPLOTLIB

if TYPE_CHECKING:
    from collections.abc import Iterator
    from os import PathLike

    from matplotlib.backend_bases import RendererBase

    from probation._arrays import FloatArray

FORMATS = (".png", ".svg", ".pdf")

_DRAWN = 2000  # more points than that cannot be distinguished in a figure

_DECIMALS = re.compile(r"-?\d+\.\d{3,}")


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style within the block, whatever the user's own settings."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(cast("Any", MATPLOTLIB))
        yield


def new_figure(width: float = 7.2, height: float = 4.2) -> Figure:
    """A figure of that size [inch], bound to no window; use within `house_style`."""
    return SafeFigure(figsize=(width, height), layout="constrained")


class SafeFigure(Figure):
    """A figure in which text is data: nothing in it is taken for mathematics, and what does not print is escaped."""

    def draw(self, renderer: RendererBase) -> None:
        """Draw, in a window as into a file."""
        numbers = {
            label
            for axes in self.axes
            for axis in (axes.xaxis, axes.yaxis)
            if isinstance(axis.get_major_formatter(), LogFormatter)  # it writes powers of ten as mathematics
            for tick in (*axis.get_major_ticks(), *axis.get_minor_ticks())
            for label in (tick.label1, tick.label2)
        }
        for text in self.findobj(Text):
            if isinstance(text, Text) and text not in numbers:
                text.set_parse_math(False)
                if (shown := printable_lines(text.get_text())) != text.get_text():
                    text.set_text(shown)
        super().draw(renderer)


def save_figure(figure: Figure, path: str | PathLike[str]) -> None:
    """Save as PNG, SVG or PDF, by the ending.

    Raises
    ------
    InputError
        For another ending, or where the file cannot be written.
    """
    suffix = Path(path).suffix.lower()
    if suffix not in FORMATS:
        raise InputError(f"{path}: found the ending {suffix!r}, expected one of {', '.join(FORMATS)}")
    stream = io.BytesIO()
    with house_style():
        metadata = {"Date": None} if suffix == ".svg" else {"CreationDate": None} if suffix == ".pdf" else None
        figure.savefig(stream, format=suffix[1:], dpi=150, metadata=metadata)
    write_whole(path, stream.getvalue())


def figure_to_svg(figure: Figure, label: str) -> str:
    """A figure as an ``<svg>`` element to stand in a page.

    Text stays text, the background is clear, and the colours follow the page from light to dark through the custom
    properties of `style.css_variables`.

    Parameters
    ----------
    figure : Figure
    label : str
        What it shows, for those who cannot see it; unique within a page.
    """
    stream = io.StringIO()
    with house_style():
        mpl.rcParams["svg.hashsalt"] = printable(label)
        figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    svg = stream.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<g id="[^"]*">', "<g>", svg)
    svg = re.sub(r"<!--.*?-->", "", svg)
    svg = re.sub(r"(font(?:-family)?: [^;\"']*)'[^;\"]*", r"\1var(--sans, sans-serif)", svg)
    for name, each in COLOURS.items():
        svg = svg.replace(each.light, f"var(--{name}, {each.light})")
    svg = re.sub(r"<[^>]*>", lambda tag: _DECIMALS.sub(_shortened, tag[0]), svg)
    svg = re.sub(r"\n\s*", "\n", svg)
    return re.sub(
        r"<svg[^>]*?(viewBox=\"[^\"]*\")[^>]*>",
        lambda match: (
            f'<svg {match[1]} role="img" aria-label="{escape(printable(label))}" xmlns="http://www.w3.org/2000/svg" '
            f'xmlns:xlink="http://www.w3.org/1999/xlink">'
        ),
        svg,
        count=1,
    )


def _shortened(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def thinned(x: FloatArray, y: FloatArray, limit: int = _DRAWN) -> tuple[FloatArray, FloatArray]:
    """At most about `limit` points that draw the same line: the first, lowest and highest of each stretch.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
    limit : int
    """
    if len(x) <= limit:
        return x, y
    edges = np.linspace(0, len(x), limit // 3 + 1).astype(int)
    kept = {len(x) - 1}
    for first, end in pairwise(edges):
        stretch = y[first:end]
        kept |= {int(first), int(first + stretch.argmin()), int(first + stretch.argmax())}
    at = np.array(sorted(kept))
    return x[at], y[at]
