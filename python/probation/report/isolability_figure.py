"""Which effects these tests could discriminate: a map of effects against their rivals."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING, Any

from matplotlib.colors import to_rgba
from matplotlib.patches import Rectangle

from probation.report.diagnosis_words import count_text
from probation.report.figures import NARROW, house_style, legend_outside, new_figure
from probation.report.style import colour
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.design.isolability_result import Isolability
    from probation.design.plan import Plan
    from probation.diagnosis.isolability import CampaignIsolability

DARKENING_CHANCES = (0.95, 0.8, 0.6)
"""Chances of naming the right one of two below which a cell darkens; 0.5 is a toss of a coin."""

_ALPHAS = (0.15, 0.3, 0.5)  # no darker: numbers stand in the cells, on a dark page too
_ROOM = 25
_ROWS = 8  # the axis is as high as so many at least: its label has to stand beside it
_NARROWS = 8  # so many columns of numbers fit on a telephone
_LINE = 38
_LETTERS = 7.5  # points
_NUMBERED_LINE = 24  # letters of a title beside a map on a telephone
_TWO_LINES = 0.27  # inch that two of them take


def isolability_figure(isolability: Isolability) -> Figure:
    """How probably the effect of a row, which is there, would be named rather than the one of a column."""
    titles = [effect.title for effect in isolability.effects]
    return chance_map(titles, isolability.probability, [effect.detectability for effect in isolability.effects])


def chance_map(titles: list[str], probability: FloatArray, detectability: list[float]) -> Figure:
    """The map.

    Parameters
    ----------
    probability : ndarray, shape (n, n)
        Of naming the row's effect, which is there, rather than the column's.
    detectability : list of float, length n
        Length of each effect's signal in standard deviations.
    """
    count = len(titles)
    with house_style():
        size = 0.19 if count > _ROOM else 0.215
        figure = new_figure(7.2, 1.6 + size * max(count, _ROWS) + 0.9)
        _map(figure.subplots(), [fill(title, _LINE) for title in titles], probability, detectability)
        figure.axes[0].set_xticks(range(count), titles, rotation=90, fontsize=_LETTERS)
        _explain(figure)
        if count > _NARROWS:
            figure.on_a_telephone = _numbered(titles, probability, detectability)
    return figure


def _numbered(titles: list[str], probability: FloatArray, detectability: list[float]) -> Figure:
    """The map without room for the titles of columns, which are numbered as the rows, nor for numbers in the cells."""
    count = len(titles)
    figure = new_figure(NARROW, 1.9 + _TWO_LINES * count)
    names = [fill(f"{title} {at}", _NUMBERED_LINE) for at, title in enumerate(titles, 1)]
    _map(figure.subplots(), names, probability, detectability, written=False)
    shown = range(0, count, 1 + count // 12)
    figure.axes[0].set_xticks(shown, [str(at + 1) for at in shown], fontsize=_LETTERS)
    figure.axes[0].set_xlabel("… might it be taken for that number?")
    _explain(figure)
    return figure


def _map(
    axes: Axes, names: list[str], probability: FloatArray, detectability: list[float], *, written: bool = True
) -> None:
    count = len(names)
    beside: dict[str, Any] = {
        "xycoords": ("axes fraction", "data"),
        "textcoords": "offset points",
        "fontsize": _LETTERS,
    }
    for row in range(count):
        seen = detectability[row] >= DESIGN.detected
        if not seen:
            axes.add_patch(
                Rectangle((-0.5, row - 0.5), count, 1.0, facecolor=colour("data"), alpha=0.3, lw=0, zorder=1)
            )
        for column in range(count):
            if row == column:
                axes.plot(column, row, ".", ms=3, color=colour("muted"))
            elif seen and (alpha := _alpha(float(probability[row, column]))):
                _cell(axes, column, row, alpha, float(probability[row, column]) if written else None)
        axes.annotate(count_text(detectability[row]), (1.0, row), (4.0, 0.0), va="center", **beside)
    axes.annotate("signal / noise [–]", (1.0, -0.5), (4.0, 4.0), va="bottom", rotation=90, **beside)
    axes.xaxis.tick_top()
    axes.xaxis.set_label_position("top")
    axes.set_yticks(range(count), names, fontsize=_LETTERS)
    axes.set(xlim=(-0.5, count - 0.5), ylim=(count - 0.5, -0.5))
    axes.set(xlabel="… might it be taken for this one?", ylabel="if this effect is there …")
    axes.tick_params(length=0)
    axes.spines[["left", "bottom"]].set_visible(False)


def _explain(figure: Figure) -> None:
    handles = _legend()
    legend_outside(figure, handles, [str(handle.get_label()) for handle in handles], "upper left", columns=3)


def _alpha(chance: float) -> float:
    """How dark a cell is: 0 where the right one is named in 95 of 100 cases."""
    return next(
        (alpha for level, alpha in zip(DARKENING_CHANCES[::-1], _ALPHAS[::-1], strict=True) if chance < level), 0.0
    )


def _cell(axes: Axes, column: float, row: float, alpha: float, chance: float | None) -> None:
    """A square of that shade, with the chance [percent] in it where there is one."""
    axes.add_patch(
        Rectangle((column - 0.5, row - 0.5), 1.0, 1.0, facecolor=colour("second"), alpha=alpha, lw=0, zorder=2)
    )
    if chance is not None:
        axes.text(column, row, f"{100.0 * chance:.0f}", ha="center", va="center", fontsize=6.5, zorder=3)


def _legend() -> list[Rectangle]:
    entries = [
        ("discriminated", "second", 0.0),
        ("80 to 95 % right", "second", _ALPHAS[0]),
        ("60 to 80 %", "second", _ALPHAS[1]),
        ("little better than a coin", "second", _ALPHAS[2]),
        ("not seen at all", "data", 0.3),
    ]
    edge = to_rgba(colour("muted"))
    return [
        Rectangle((0, 0), 1, 1, facecolor=to_rgba(colour(shade), alpha), edgecolor=edge, lw=0.5, label=label)
        for label, shade, alpha in entries
    ]


def campaign_isolability_figure(answer: CampaignIsolability) -> Figure:
    """The map of a campaign's answer."""
    return isolability_figure(answer.found)


def plan_figure(plan: Plan) -> Figure:
    """The map of planned tests."""
    return isolability_figure(plan.isolability)
