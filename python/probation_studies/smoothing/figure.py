"""A comparison of methods as a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.report.figures import house_style, legend_outside, new_figure
from probation.report.style import series_colour

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation_studies.smoothing.comparison import Comparison


def comparison_figure(comparison: Comparison) -> Figure:
    """The error of every method over the noise, one panel per history."""
    histories = list(dict.fromkeys(key[0] for key in comparison.results))
    with house_style():
        rows = -(-len(histories) // 3)
        figure = new_figure(9.2, 0.6 + 2.7 * rows)
        panels = np.ravel(figure.subplots(rows, min(3, len(histories)), sharex=True, sharey=True, squeeze=False))
        for panel, history in zip(panels, histories, strict=False):
            for at, method in enumerate(comparison.methods):
                noises, errors = comparison.errors_over_noise(history, method)
                if noises:
                    panel.plot(noises, errors, ".-", ms=6, color=series_colour(at), label=method)
            panel.set(xscale="log", yscale="log", title=history)
        for panel in panels[len(histories) :]:
            panel.set_axis_off()
        figure.supxlabel("strain noise [–]", fontsize=9)
        figure.supylabel("p95 of the relative error of the rate [%]", fontsize=9)
        legend_outside(figure, *panels[0].get_legend_handles_labels(), columns=3)
    return figure
