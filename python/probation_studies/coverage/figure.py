"""The coverage study as a figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.parameter import SYMBOLS
from probation.report.figures import legend_outside, styled_figure
from probation.report.style import colour, series_colour
from probation.settings.identification import IDENTIFICATION
from probation_studies.coverage.study import TRUTH

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from probation_studies.coverage.study import Coverage


def coverage_figure(coverage: Coverage) -> Figure:
    """Coverage of the 95 % intervals with its exact 99 % interval: a panel per parameter, a row per kind of noise."""
    cases = list(dict.fromkeys(counted_case.case for counted_case in coverage.counted))
    methods = list(dict.fromkeys(counted_case.method for counted_case in coverage.counted))
    with styled_figure(9.0, 0.9 + 0.55 * len(cases)) as figure:
        panels = figure.subplots(1, len(TRUTH), sharey=True)
        for axes, name in zip(panels, TRUTH, strict=True):
            axes.axvline(100 * IDENTIFICATION.nominal_coverage, color=colour("muted"), lw=0.8)
            for at, method in enumerate(methods):
                rows = [coverage.of(case, method) for case in cases]
                centre = np.array([100 * row.coverage(name) for row in rows])
                ends = 100 * np.array([row.interval(name) for row in rows])
                height = np.arange(len(cases)) + 0.22 * (at - 0.5 * (len(methods) - 1))
                reach = np.abs(ends.T - centre)
                axes.errorbar(
                    centre, height, xerr=reach, fmt="o", ms=3.5, lw=1.2, color=series_colour(at), label=method
                )
            axes.set(title=SYMBOLS[name], xlabel="coverage [%]", xlim=(0.0, 103.0))
        panels[0].set_yticks(np.arange(len(cases)), cases)
        panels[0].invert_yaxis()
        legend_outside(figure, *panels[0].get_legend_handles_labels(), columns=len(methods))
    return figure
