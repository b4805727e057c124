"""What changed from one campaign to another: its figures and its page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.comparison.headline import named, sized
from probation.provenance import provenance
from probation.report.diagnosis_words import short_ids
from probation.report.figures import legend_outside, styled_figure, thinned
from probation.report.page import Gallery, Page, Section, picture
from probation.report.skipped_words import skipped_lines
from probation.report.style import colour
from probation.report.table import Table
from probation.wording import chance, listed, sentence

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation.comparison.result import ChangeCurves, Comparison
    from probation.report.page import Mood

_EXPLANATIONS = 20
_MOOD: dict[str, Mood] = {"nothing_changed": "good", "changed": "neutral", "unknown_change": "bad"}


def comparison_figure(comparison: Comparison) -> Figure:
    """Every record minus what its references predict, twice the noise, and what the best explanation says."""
    short = short_ids(comparison.curves)
    with styled_figure(8.4, 0.9 + 1.9 * len(comparison.curves)) as figure:
        panels = figure.subplots(len(comparison.curves), 1, squeeze=False)[:, 0]
        for axes, (name, curves) in zip(panels, comparison.curves.items(), strict=True):
            _draw(axes, curves)
            axes.set_title(short[name])
        panels[-1].set_xlabel("time [s]")
        _name_curves(figure)
    return figure


def change_figure(comparison: Comparison, record: str) -> Figure:
    """The same of one record, as its page has them side by side."""
    with styled_figure(4.1, 2.9) as figure:
        axes = figure.subplots()
        _draw(axes, comparison.curves[record])
        axes.set_xlabel("time [s]")
        axes.set_title(short_ids(comparison.curves)[record])
        _name_curves(figure)
    return figure


def _draw(axes: Axes, curves: ChangeCurves) -> None:
    axes.fill_between(curves.time, -2.0 * curves.noise, 2.0 * curves.noise, color=colour("grid"), label="2 × noise")
    axes.plot(*thinned(curves.time, curves.change), color=colour("data"), lw=0.9, label="change")
    if curves.explained is not None:
        axes.plot(*thinned(curves.time, curves.explained), color=colour("model"), lw=1.3, label="explained")
    axes.set_ylabel("Δ true stress [MPa]")


def _name_curves(figure: Figure) -> None:
    """One legend for all panels."""
    named = (axes.get_legend_handles_labels() for axes in figure.axes)
    handles = {label: handle for legend in named for handle, label in zip(*legend, strict=True)}
    legend_outside(figure, list(handles.values()), list(handles), columns=3)


def write_comparison_page(comparison: Comparison, path: Path) -> None:
    """Write the page."""
    names = short_ids(comparison.curves)
    pictures = tuple(
        picture(
            change_figure(comparison, record),
            f"{names[record]}: what was measured minus what {listed(against)} predicts",
        )
        for record, against in comparison.pairs.items()
    )
    mind = [
        *([sentence(comparison.scatter.text)] if comparison.scatter.any else []),
        *map(sentence, comparison.warnings),
    ]
    left_out = Table(("left out",), tuple((line,) for line in skipped_lines(comparison.skipped)), left=1)
    sections = [
        Section("What changed", (_explanations(comparison),)),
        Section("Record by record", (_records(comparison), Gallery(pictures))),
        *([Section("Mind", tuple(mind))] if mind else []),
        *([Section("What was not tried", (left_out,))] if comparison.skipped else []),
    ]
    Page(
        title=f"{comparison.campaign} against {comparison.reference}: what changed?",
        verdict=comparison.headline,
        mood=_MOOD[comparison.verdict],
        sections=tuple(sections),
        provenance=provenance(),
    ).write(path)


def _explanations(comparison: Comparison) -> Table:
    """The most probable explanations; a star marks those that the data do not exclude."""
    rows = tuple(
        (
            "★" if explanation in comparison.answer_set else "",
            named(explanation),
            ", ".join(explanation.records),
            "\n".join(sized(explanation)),
            chance(explanation.probability),
        )
        for explanation in comparison.explanations[:_EXPLANATIONS]
    )
    caption = "What may have changed (★: not excluded by the data)"
    return Table(("", "change", "in", "its size (95 % interval)", "probability"), rows, caption, left=4)


def _records(comparison: Comparison) -> Table:
    names = short_ids(comparison.curves)
    rows = tuple(
        (names[name], ", ".join(others), f"{comparison.rms_MPa[name]:.3g}", f"{comparison.noise_MPa[name]:.3g}")
        for name, others in comparison.pairs.items()
    )
    return Table(("record", "against", "change, rms [MPa]", "noise [MPa]"), rows, "How far each record is off", left=2)
