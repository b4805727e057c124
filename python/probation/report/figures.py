"""Figures: made in the house style, saved as files, put into pages as SVG."""

from __future__ import annotations

import io
import json
import re
import warnings
from contextlib import contextmanager
from html import escape
from importlib import import_module
from itertools import pairwise
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any, Literal, cast

import matplotlib as mpl
import numpy as np
from matplotlib.collections import QuadMesh
from matplotlib.figure import Figure
from matplotlib.gridspec import GridSpec
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.ticker import (
    FixedFormatter,
    FuncFormatter,
    LogFormatter,
    LogLocator,
    NullFormatter,
    StrMethodFormatter,
)

from probation._files import write_whole
from probation._text import printable, printable_lines
from probation.errors import InputError
from probation.progress import in_notebook
from probation.report.style import COLOURS, MATPLOTLIB

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence
    from os import PathLike

    from matplotlib.artist import Artist
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.backend_bases import RendererBase
    from matplotlib.lines import Line2D

    from probation._arrays import FloatArray

FORMATS = (".png", ".svg", ".pdf")

NARROW = 4.3
"""Width [inch] of a figure on a telephone: 10 pixels to a letter's height where 350 pixels are wide enough."""

_TITLES: tuple[Literal["left", "center", "right"], ...] = ("left", "center", "right")
_LINE = 48  # letters of a title across a narrow figure
_MARKED = 6  # letters' width that the line and the gaps of an entry of a legend take
_LEGEND_LINE = 0.17  # inch

_MOST_PIXELS = 40_000  # of a map that a page tells the values of
_DRAWN = 2000  # more points than that cannot be distinguished in a figure

_DECIMALS = re.compile(r"-?\d+\.\d{3,}")


@contextmanager
def house_style() -> Iterator[None]:
    """Draw in the house style within the block, whatever the user's own settings."""
    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(cast("Any", MATPLOTLIB))
        yield


def new_figure(width: float = 7.2, height: float = 4.2) -> SafeFigure:
    """A figure of that size [inch], bound to no window; use within `house_style`."""
    return SafeFigure(figsize=(width, height), layout="constrained")


@contextmanager
def styled_figure(width: float = 7.2, height: float = 4.2) -> Iterator[SafeFigure]:
    """A figure of that size [inch] that is drawn in the house style within the block."""
    with house_style():
        yield new_figure(width, height)


class SafeFigure(Figure):
    """A figure in which text is data: nothing in it is taken for mathematics, and what does not print is escaped."""

    on_a_telephone: Figure | None = None
    """What a telephone gets instead, where this one made narrower, its panels one below the other, is of no use."""

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

    def show(self, warn: bool = True) -> None:
        """Show it: as a picture in a notebook, else in a window, until that is closed.

        Raises
        ------
        InputError
            Where there is neither a notebook nor a display.
        """
        if in_notebook():
            import_module("IPython.display").display(self)
            return
        from matplotlib import pyplot as plt  # noqa: PLC0415 - it looks for a display, which only this needs

        window = plt.figure()
        if window.canvas.required_interactive_framework is None:
            plt.close(window)
            raise InputError(
                f"found no display to show a figure on (matplotlib draws by {mpl.get_backend()}), expected one; "
                'savefig("figure.png") writes it into a file'
            )
        canvas = window.canvas
        canvas.figure = self
        self.set_canvas(canvas)
        plt.show()


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
    properties of `style.css_variables`. The attribute `data-axes` and the groups with `data-curve` tell the script of
    a page which values a pointer stands on.

    Parameters
    ----------
    label : str
        What it shows, for those who cannot see it; unique within a page.
    """
    stream = io.StringIO()
    curves = {(at, of): line for at, axes in enumerate(figure.axes) for of, line in enumerate(_curves(axes))}
    for (at, of), line in curves.items():
        line.set_gid(f"curve-{at}-{of}")
    with house_style(), warnings.catch_warnings():
        # Of a narrow figure whose labels leave no room: it is drawn without layout; the page also has a wide one.
        warnings.filterwarnings("ignore", "constrained_layout not applied")
        mpl.rcParams["svg.hashsalt"] = printable(label)
        figure.savefig(stream, format="svg", transparent=True, metadata={"Date": None, "Creator": None})
    for line in curves.values():
        line.set_gid(None)
    svg = stream.getvalue()
    svg = svg[svg.index("<svg") :]
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<g id="curve-(\d+-\d+)">', r'<g data-curve="\1">', svg)
    svg = re.sub(r'<g id="[^"]*">', "<g>", svg)
    svg = re.sub(r"<!--.*?-->", "", svg)
    svg = re.sub(r"(font(?:-family)?: [^;\"']*)'[^;\"]*", r"\1var(--sans, sans-serif)", svg)
    for name, shade in COLOURS.items():
        svg = svg.replace(shade.light, f"var(--{name}, {shade.light})")
    svg = re.sub(r"<[^>]*>", lambda tag: _DECIMALS.sub(_shortened, tag[0]), svg)
    svg = re.sub(r"\n\s*", "\n", svg)
    return re.sub(
        r"<svg[^>]*?(viewBox=\"[^\"]*\")[^>]*>",
        lambda match: (
            f'<svg {match[1]} role="img" aria-label="{escape(printable(label))}" data-axes="{_axes(figure)}" '
            f'xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink">'
        ),
        svg,
        count=1,
    )


def narrow(figure: Figure) -> Figure | None:
    """What a telephone gets of a figure: itself made as narrow as `NARROW`, panels side by side one below the other.

    Returns
    -------
    Figure or None
        The same figure, changed; or what it names for a telephone; None where it is narrow already.
    """
    if (other := getattr(figure, "on_a_telephone", None)) is not None:
        return cast("Figure", other)
    if figure.get_figwidth() <= NARROW:
        return None
    width, height = figure.get_size_inches()
    panels = [(axes, spec) for axes in figure.axes if (spec := axes.get_subplotspec()) is not None]
    rows = max((spec.get_gridspec().nrows for _, spec in panels), default=1)
    if any(spec.get_gridspec().ncols > 1 for _, spec in panels):
        grid = GridSpec(len(panels), 1, figure=figure)
        for at, (axes, _) in enumerate(panels):
            names = {f"{direction}label": _label_of(axes, direction) for direction in "xy"}
            axes.set_subplotspec(grid[at])
            axes.tick_params(labelbottom=True, labelleft=True)
            axes.set(**names)
        height *= 0.8 * len(panels) / rows
    elif not any(_bears_names(axes.yaxis) for axes in figure.axes):
        height *= max(NARROW / width, 0.75)  # rows with names keep their height
    for axes in figure.axes:
        titles = {axes.get_title(loc) for loc in _TITLES}
        for text in axes.findobj(Text, include_self=False):
            if isinstance(text, Text) and (text in axes.texts or text.get_text() in titles):
                text.set_text(fill(text.get_text(), _LINE))
        for axis in (axes.xaxis, axes.yaxis):
            if axis.get_scale() == "log":
                number_logarithmic(axis)
    for legend in list(figure.legends):
        handles, labels = (
            [handle for handle in legend.legend_handles if handle is not None],
            [text.get_text() for text in legend.get_texts()],
        )
        place = next(name for name, code in Legend.codes.items() if code == getattr(legend, "_loc", None))
        legend.remove()
        with house_style():
            height += _LEGEND_LINE * (legend_outside(figure, handles, labels, place, width=NARROW) - 1)
    figure.set_size_inches(NARROW, height)
    _break_labels(figure)
    return figure


def legend_outside(
    figure: Figure,
    handles: Sequence[Artist],
    labels: Sequence[str],
    place: str = "lower center",
    *,
    columns: int = 4,
    width: float | None = None,
) -> int:
    """Name the curves of all panels beside them, in as many columns as the figure is wide enough for.

    Parameters
    ----------
    handles : sequence of Artist
    labels : sequence of str
        A label that is wider than the figure is broken.
    place : {"lower center", "upper left"}
    columns : int
        At most so many.
    width : float, optional [inch]
        Of the figure; by default as wide as it is.

    Returns
    -------
    int
        Lines of text, one below the other.
    """
    letters = int(_LINE * (figure.get_figwidth() if width is None else width) / NARROW)
    broken = [fill(label, letters - _MARKED) for label in labels]
    widest = max((len(line) for label in broken for line in label.splitlines()), default=0)
    most = max(1, min(columns, letters // (widest + _MARKED)))
    tall = max(1, -(-len(broken) // most))  # a column is filled before the next
    stacks = [broken[at : at + tall] for at in range(0, len(broken), tall)]
    figure.legend(handles, broken, loc=cast("Any", f"outside {place}"), ncols=max(1, len(stacks)))
    return max((sum(1 + label.count("\n") for label in stack) for stack in stacks), default=1)


def number_logarithmic(axis: Axis) -> None:
    """Number a logarithmic axis so that nothing overlaps: decades, or 1, 2 and 5 where there are fewer than two."""
    low, high = axis.get_view_interval()
    if high > 5.0 * low:
        axis.set_minor_formatter(NullFormatter())
        if high < 100.0 * low:
            axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
            axis.set_major_formatter(StrMethodFormatter("{x:g}"))


def _break_labels(figure: Figure) -> None:
    """Break labels that are longer than the axis that they stand at."""
    with house_style():
        figure.draw_without_rendering()
        for axes in figure.axes:
            label = axes.yaxis.label
            room = axes.get_window_extent().height
            if (needed := label.get_window_extent().height) > room:
                letters = int(len(label.get_text()) * room / needed)
                axes.set_ylabel(fill(label.get_text(), max(letters, 1), break_long_words=False))


def _curves(axes: Axes) -> list[Line2D]:
    """Lines and dots that stand for data: not the line at zero, which runs from edge to edge."""
    return [line for line in axes.lines if line.get_transform() == axes.transData and np.size(line.get_xdata()) > 1]


def _axes(figure: Figure) -> str:
    """Where the axes of a figure lie in its SVG, their values, labels and curves, as JSON for an attribute."""
    width, height = 72.0 * figure.get_size_inches()
    known = []
    for axes in figure.axes:
        place = axes.get_position()
        known.append(
            {
                "x": _scale(axes.xaxis, place.x0 * width, place.x1 * width, _label_of(axes, "x")),
                "y": _scale(axes.yaxis, (1.0 - place.y0) * height, (1.0 - place.y1) * height, _label_of(axes, "y")),
                "curves": [
                    "" if (label := str(line.get_label())).startswith("_") else printable(label)
                    for line in _curves(axes)
                ],
                **_map(axes),
            }
        )
    return escape(json.dumps(known, ensure_ascii=False, separators=(",", ":")))


def _map(axes: Axes) -> dict[str, object]:
    """The pixels of a map with a title, and their borders; nothing where there is no map, or a very large one."""
    title = next((text for loc in _TITLES if (text := axes.get_title(loc))), "")
    mesh = next((collection for collection in axes.collections if isinstance(collection, QuadMesh) and title), None)
    drawn = None if mesh is None else mesh.get_array()
    if mesh is None or drawn is None or drawn.ndim != 2 or drawn.size > _MOST_PIXELS:
        return {}
    corners = np.asarray(mesh.get_coordinates())
    pixels = np.ma.filled(np.ma.asarray(drawn, dtype=np.float64), np.nan)
    unit = mesh.colorbar.ax.get_ylabel().strip("[]") if mesh.colorbar else "-"
    borders = {"x": corners[0, :, 0], "y": corners[:, 0, 1]}
    return {
        "map": {
            "label": printable(title),
            "unit": "" if unit == "-" else f" {unit}",
            "values": [[float(f"{value:.3g}") if np.isfinite(value) else None for value in row] for row in pixels],
            **{name: [float(f"{border:.7g}") for border in positions] for name, positions in borders.items()},
        }
    }


def _scale(axis: Axis, first: float, last: float, label: str) -> dict[str, object] | None:
    """Ends of an axis in the drawing and in its values; None where it bears names instead of numbers."""
    if axis.get_scale() not in ("linear", "log") or _bears_names(axis):
        return None
    low, high = (float(f"{end:.7g}") for end in axis.get_view_interval())
    ends = [round(first, 2), round(last, 2), low, high]
    return {"ends": ends, "log": axis.get_scale() == "log", "label": printable(" ".join(label.split()))}


def _bears_names(axis: Axis) -> bool:
    return isinstance(axis.get_major_formatter(), (FixedFormatter, FuncFormatter))


def _label_of(axes: Axes, direction: str) -> str:
    """The label of an axis, or of one that it is shared with."""
    shared = axes.get_shared_x_axes() if direction == "x" else axes.get_shared_y_axes()
    own = getattr(axes, f"get_{direction}label")()
    others = (getattr(sibling, f"get_{direction}label")() for sibling in shared.get_siblings(axes))
    return str(own or next((label for label in others if label), ""))


def _shortened(number: re.Match[str]) -> str:
    return f"{float(number[0]):.2f}".rstrip("0").rstrip(".")


def thinned(x: FloatArray, y: FloatArray, limit: int = _DRAWN) -> tuple[FloatArray, FloatArray]:
    """At most about `limit` points that draw the same line: the first, lowest and highest of each segment.

    Parameters
    ----------
    x, y : ndarray, shape (n,)
    """
    if len(x) <= limit:
        return x, y
    edges = np.linspace(0, len(x), limit // 3 + 1).astype(int)
    kept = {len(x) - 1}
    for first, end in pairwise(edges):
        segment = y[first:end]
        kept |= {int(first), int(first + segment.argmin()), int(first + segment.argmax())}
    at = np.array(sorted(kept))
    return x[at], y[at]
