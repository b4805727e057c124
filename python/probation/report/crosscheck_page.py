"""A cross-check of the schemes: error against step and against time, and the page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.report.crosscheck_summary import notes, record_table
from probation.report.figures import legend_outside, number_logarithmic, styled_figure
from probation.report.page import Page, Section, picture
from probation.report.style import SERIES, colour
from probation.schemes.result import PAPERS_START

if TYPE_CHECKING:
    from collections.abc import Sequence
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.schemes.result import CrossCheck
    from probation.schemes.steps import StepStudy

_MARKERS = "osD^vPX"
_BOTTOM = 1e-13  # MPa: errors below are drawn there


def crosscheck_figure(crosscheck: CrossCheck) -> Figure:
    """Error against step and against time, with the slopes of the orders."""
    return steps_figure([record.steps for record in crosscheck.records if record.steps is not None])


def steps_figure(studies: Sequence[StepStudy]) -> Figure:
    """One row per study: error against step on the left, against the time of one solve on the right."""
    with styled_figure(7.6, 0.6 + 3.1 * max(1, len(studies))) as figure:
        if not studies:
            figure.text(0.5, 0.5, "no smooth history was asked for", ha="center")
            return figure
        rows = figure.subplots(len(studies), 2, sharey="row", squeeze=False)
        for (left, right), study in zip(rows, studies, strict=True):
            for at, (name, errors) in enumerate(study.largest_error_MPa.items()):
                drawn = np.maximum(errors, _BOTTOM)
                look = {"color": colour(SERIES[at % len(SERIES)]), "marker": _MARKERS[at % len(_MARKERS)], "ms": 3.5}
                if name == PAPERS_START:  # the same curve as be2's, away from the start
                    look |= {"mfc": "none", "ms": 6, "ls": "--"}
                left.loglog(study.step, drawn, label=name, lw=1.1, **look)
                right.loglog(study.time_us[name], drawn, lw=1.1, **look)
            _slopes(left, study)
            left.set(xlabel="step [s]", ylabel="largest error [MPa]", title=study.history)
            right.set(xlabel="time of one solve [µs]")
            for axis in (left.xaxis, right.xaxis):
                number_logarithmic(axis)
        legend_outside(figure, *rows[0][0].get_legend_handles_labels())
    return figure


def _slopes(axes: Axes, study: StepStudy) -> None:
    """Guides at the fine end: order 2 above all that have it, order 3 below sa3."""
    for names, order, apart in ((("be2", "sa2"), 2, 3.0), (("sa3",), 3, 0.25)):
        errors = [study.largest_error_MPa[name][-1] for name in names if name in study.largest_error_MPa]
        if not np.isfinite(errors).any():
            continue
        step = study.step[-3:]
        guide: FloatArray = apart * np.nanmax(errors) * (step / step[-1]) ** order
        axes.loglog(step, guide, color=colour("muted"), lw=0.8, ls="--")
        axes.annotate(
            f"order {order}",
            (step[0], guide[0]),
            xytext=(-4, 4) if apart > 1 else (4, 0),
            textcoords="offset points",
            ha="right" if apart > 1 else "left",
            va="bottom" if apart > 1 else "center",
            fontsize=8,
            color=colour("muted"),
        )


def write_crosscheck_page(crosscheck: CrossCheck, path: Path) -> None:
    """Write the page."""
    Page("Cross-check of the schemes", crosscheck.verdict, sections(crosscheck), lead=f"Law: {crosscheck.law}.").write(
        path
    )


def sections(crosscheck: CrossCheck) -> tuple[Section, ...]:
    """The parts of the page."""
    tables = [Section(record.record, (record_table(record), *notes(record))) for record in crosscheck.records]
    if not any(record.steps for record in crosscheck.records):
        return tuple(tables)
    caption = "Largest error away from the start, against the step and against the time of one solve"
    return (Section("Error, step and time", (picture(crosscheck_figure(crosscheck), caption),)), *tables)
