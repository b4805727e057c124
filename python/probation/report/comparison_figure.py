"""What changed from one campaign to another, record by record."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.diagnosis_words import short_ids
from probation.report.figures import house_style, new_figure
from probation.report.style import colour

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation.comparison.result import Comparison


def comparison_figure(found: Comparison) -> Figure:
    """Every record minus what its references predict, twice the noise, and what the best explanation says."""
    short = short_ids(found.curves)
    with house_style():
        figure = new_figure(8.4, 0.9 + 1.9 * len(found.curves))
        panels = figure.subplots(len(found.curves), 1, squeeze=False)[:, 0]
        for axes, (name, each) in zip(panels, found.curves.items(), strict=True):
            axes.fill_between(each.time, -2.0 * each.noise, 2.0 * each.noise, color=colour("grid"), label="2 × noise")
            axes.plot(each.time, each.change, color=colour("data"), lw=0.9, label="change")
            if each.explained is not None:
                axes.plot(each.time, each.explained, color=colour("model"), lw=1.3, label="explained")
            axes.set(title=short[name], ylabel="Δ true stress [MPa]")
        panels[-1].set_xlabel("time [s]")
        handles = {
            label: handle for axes in panels for handle, label in zip(*axes.get_legend_handles_labels(), strict=True)
        }
        figure.legend(list(handles.values()), list(handles), loc="outside lower center", ncols=3)
    return figure
