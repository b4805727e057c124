"""A campaign that was made of files, as a figure and as a page: every record, as it was read."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.records.said_once import of_all
from probation.report.figures import legend_outside, styled_figure
from probation.report.initial_summary import record_table
from probation.report.page import Page, Section, picture
from probation.report.style import colour

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation.records.initial.init_campaign import InitialCampaign
    from probation.records.record import Record
    from probation.report.page import Picture

_ONSET = 0.3  # of the largest value: so far the beginning is drawn
_FEWEST = 10  # samples of it
_PERFECT = 1e-12  # less than that of the strain is unexplained by rounding alone


def initial_figure(made: InitialCampaign) -> Figure:
    """Stress over strain, and strain over time, of all records."""
    with styled_figure(10.0, 4.0) as figure:
        over_strain, over_time = figure.subplots(1, 2)
        for record in made.campaign.records:
            over_strain.plot(record.true_strain, record.true_stress, lw=1.0, label=record.id)
            over_time.plot(record.time - record.time[0], record.true_strain, lw=1.0)
        _label(over_strain, over_time)
        legend_outside(figure, *over_strain.get_legend_handles_labels())
    return figure


def record_figure(record: Record) -> Figure:
    """The same of one record, and its stress over time."""
    with styled_figure(10.0, 3.2) as figure:
        over_strain, strain_axes, stress_axes = figure.subplots(1, 3)
        over_strain.plot(record.true_strain, record.true_stress, lw=1.0)
        strain_axes.plot(record.time, record.true_strain, lw=1.0)
        stress_axes.plot(record.time, record.true_stress, lw=1.0)
        _label(over_strain, strain_axes)
        stress_axes.set(xlabel="time [s]", ylabel="true stress [MPa]")
    return figure


def clocks_figure(record: Record) -> Figure:
    """How the clock of the strain file was set: the misfit over the shift, and the start of force and strain."""
    clock = record.clock
    with styled_figure(10.0, 3.2) as figure:
        if clock is None or not clock.tried.size:
            start = figure.subplots()
        else:
            misfit, start = figure.subplots(1, 2)
            misfit.semilogy(clock.tried, np.maximum(clock.misfit, _PERFECT), lw=1.0, color=colour("model"))
            misfit.axvspan(
                clock.value - 2.0 * clock.se, clock.value + 2.0 * clock.se, color=colour("second"), alpha=0.3
            )
            misfit.axvline(clock.value, lw=1.0, color=colour("second"))
            misfit.set(xlabel="shift of the strain file [s]", ylabel="unexplained part [–]")
        _draw_start(start, record)
    return figure


def _draw_start(axes: Axes, record: Record) -> None:
    """Force and strain over time, as parts of their largest value: of one test, they start together."""
    for label, values, shade in (
        ("stress, of the force file", record.true_stress, "model"),
        ("strain, of the strain file", record.true_strain, "second"),
    ):
        size = np.abs(values)
        part = size / max(float(size.max()), 1e-300)
        end = max(int(np.argmax(part > _ONSET)) + 1, _FEWEST)
        axes.plot(record.time[:end], part[:end], ".-", ms=3, lw=1.0, color=colour(shade), label=label)
    axes.set(xlabel="time [s]", ylabel="part of the largest value [–]")
    axes.legend()


def _label(over_strain: Axes, over_time: Axes) -> None:
    over_strain.set(xlabel="true strain [–]", ylabel="true stress [MPa]")
    over_time.set(xlabel="time [s]", ylabel="true strain [–]")


def _clocks(record: Record) -> tuple[Picture, ...]:
    if record.clock is None:
        return ()
    tried = "what each shift leaves unexplained, two standard errors shaded, and " if record.clock.tried.size else ""
    caption = f"{record.id}: {tried}the beginning of the test on one clock."
    return (picture(clocks_figure(record), caption),)


def write_initial_page(made: InitialCampaign, path: Path) -> None:
    """Write the page."""
    records = made.campaign.records
    common = of_all(records)
    sections = [Section("Records", (record_table(made), *(f"Note on all records: {text}." for text in common)))]
    sections += [
        Section(
            record.id,
            (
                f"Read from {made.reads[record.id]}.",
                *(f"Note: {warning}." for warning in record.warnings if warning not in common),
                picture(record_figure(record), f"{record.id}: stress over strain, strain and stress over time."),
                *_clocks(record),
            ),
        )
        for record in records
    ]
    Page(
        title=f"Records of {made.campaign.name}",
        verdict=f"{len(records)} {'record' if len(records) == 1 else 'records'} read.",
        lead="Look at each: do the axes fit, does the test start at zero, is it the specimen that was meant? "
        "campaign.toml beside this page says how each is read, and can be changed.",
        sections=tuple(sections),
    ).write(path)
