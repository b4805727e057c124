"""What changed from one campaign to another, as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.comparison.headline import named, sized
from probation.provenance import provenance
from probation.report.comparison_figure import change_figure
from probation.report.diagnosis_words import short_ids
from probation.report.page import Gallery, Page, Section, picture
from probation.report.skipped_words import skipped_lines
from probation.report.table import Table
from probation.wording import chance, listed, sentence

if TYPE_CHECKING:
    from pathlib import Path

    from probation.comparison.result import Comparison
    from probation.report.page import Mood

_EXPLANATIONS = 20
_MOOD: dict[str, Mood] = {"nothing_changed": "good", "changed": "neutral", "unknown_change": "bad"}


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
