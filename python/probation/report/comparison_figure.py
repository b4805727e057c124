"""What changed from one campaign to another, record by record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.diagnosis_words import short_ids
from probation.report.figures import house_style, legend_outside, new_figure, thinned
from probation.report.style import colour

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation.comparison.result import ChangeCurves, Comparison


def comparison_figure(found: Comparison) -> Figure:
    """Every record minus what its references predict, twice the noise, and what the best explanation says."""
    short = short_ids(found.curves)
    with house_style():
        figure = new_figure(8.4, 0.9 + 1.9 * len(found.curves))
        panels = figure.subplots(len(found.curves), 1, squeeze=False)[:, 0]
        for axes, (name, each) in zip(panels, found.curves.items(), strict=True):
            _draw(axes, each)
            axes.set_title(short[name])
        panels[-1].set_xlabel("time [s]")
        _name_curves(figure)
    return figure


def change_figure(found: Comparison, record: str) -> Figure:
    """The same of one record, as its page has them side by side."""
    with house_style():
        figure = new_figure(4.1, 2.9)
        axes = figure.subplots()
        _draw(axes, found.curves[record])
        axes.set_xlabel("time [s]")
        axes.set_title(short_ids(found.curves)[record])
        _name_curves(figure)
    return figure


def _draw(axes: Axes, each: ChangeCurves) -> None:
    axes.fill_between(each.time, -2.0 * each.noise, 2.0 * each.noise, color=colour("grid"), label="2 × noise")
    axes.plot(*thinned(each.time, each.change), color=colour("data"), lw=0.9, label="change")
    if each.explained is not None:
        axes.plot(*thinned(each.time, each.explained), color=colour("model"), lw=1.3, label="explained")
    axes.set_ylabel("Δ true stress [MPa]")


def _name_curves(figure: Figure) -> None:
    """One legend for all panels."""
    named = (axes.get_legend_handles_labels() for axes in figure.axes)
    handles = {label: handle for each in named for handle, label in zip(*each, strict=True)}
    legend_outside(figure, list(handles.values()), list(handles), columns=3)
