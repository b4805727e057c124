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


def comparison_figure(found: Comparison) -> Figure:
    """Every record minus what its references predict, twice the noise, and what the best explanation says."""
    short = short_ids(found.curves)
    with styled_figure(8.4, 0.9 + 1.9 * len(found.curves)) as figure:
        panels = figure.subplots(len(found.curves), 1, squeeze=False)[:, 0]
        for axes, (name, each) in zip(panels, found.curves.items(), strict=True):
            _draw(axes, each)
            axes.set_title(short[name])
        panels[-1].set_xlabel("time [s]")
        _name_curves(figure)
    return figure


def change_figure(found: Comparison, record: str) -> Figure:
    """The same of one record, as its page has them side by side."""
    with styled_figure(4.1, 2.9) as figure:
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


def write_comparison_page(found: Comparison, path: Path) -> None:
    """Write the page."""
    names = short_ids(found.curves)
    pictures = tuple(
        picture(
            change_figure(found, record), f"{names[record]}: what was measured minus what {listed(against)} predicts"
        )
        for record, against in found.pairs.items()
    )
    mind = [
        *([sentence(found.scatter.text)] if found.scatter.any else []),
        *map(sentence, found.warnings),
    ]
    left_out = Table(("left out",), tuple((each,) for each in skipped_lines(found.skipped)), left=1)
    sections = [
        Section("What changed", (_explanations(found),)),
        Section("Record by record", (_records(found), Gallery(pictures))),
        *([Section("Mind", tuple(mind))] if mind else []),
        *([Section("What was not tried", (left_out,))] if found.skipped else []),
    ]
    Page(
        title=f"{found.campaign} against {found.reference}: what changed?",
        verdict=found.headline,
        mood=_MOOD[found.verdict],
        sections=tuple(sections),
        provenance=provenance(),
    ).write(path)


def _explanations(found: Comparison) -> Table:
    """The most probable explanations; a star marks those that the data cannot tell apart."""
    rows = tuple(
        (
            "★" if each in found.answer_set else "",
            named(each),
            ", ".join(each.records),
            "\n".join(map(sized, each.parameters)),
            chance(each.probability),
        )
        for each in found.explanations[:_EXPLANATIONS]
    )
    caption = "What may have changed (★: the data cannot tell these apart)"
    return Table(("", "change", "in", "its size (95 % interval)", "probability"), rows, caption, left=4)


def _records(found: Comparison) -> Table:
    names = short_ids(found.curves)
    rows = tuple(
        (names[name], ", ".join(others), f"{found.rms_MPa[name]:.3g}", f"{found.noise_MPa[name]:.3g}")
        for name, others in found.pairs.items()
    )
    return Table(("record", "against", "change, rms [MPa]", "noise [MPa]"), rows, "How far each record is off", left=2)
