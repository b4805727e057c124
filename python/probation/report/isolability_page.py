"""What tests could discriminate, as a page: those of a campaign, and planned ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report.isolability_figure import isolability_figure
from probation.report.isolability_table import HOW_TO_READ, in_words, isolability_table
from probation.report.page import Page, Section, picture
from probation.report.plan_summary import correlations, parameter_table, plan_verdict, tests_table
from probation.wording import sentence

if TYPE_CHECKING:
    from pathlib import Path

    from probation.design.isolability_result import Isolability
    from probation.design.plan import Plan
    from probation.diagnosis.isolability import CampaignIsolability

HOW_TO_READ_THE_MAP = (
    "Suppose that the effect of a row is really there, at its usual size: an orange cell says that these tests might "
    "take it for the effect of that column, and its number, where there is room for one, is the chance [%] that the "
    "right one of the two is named. No colour means discriminated; a grey row means that these tests would not see "
    "the effect at all."
)


def write_isolability_page(answer: CampaignIsolability, path: Path) -> None:
    """Write the page."""
    isolability = answer.found
    Page(
        title=f"What the tests of {answer.campaign} could discriminate",
        verdict=in_words(isolability.headline, isolability),
        lead="Asked of the strain histories, the noise and the base law alone; what the records show plays no part.",
        sections=effect_sections(isolability),
        provenance=provenance(answer.data_sha256),
    ).write(path)


def effect_sections(isolability: Isolability) -> tuple[Section, ...]:
    """The map of effects, unless there is but one; then every effect in a table and in words."""
    several = [isolability_figure(isolability)] if len(isolability.effects) > 1 else []
    maps = [picture(figure, "Chance of naming the right one of two [%].") for figure in several]
    return (
        *(Section("Which effect could be taken for which", (HOW_TO_READ_THE_MAP, drawn)) for drawn in maps),
        Section("Effect by effect", (isolability_table(isolability), HOW_TO_READ)),
        Section("In words", tuple(in_words(effect.sentence, isolability) for effect in isolability.effects)),
    )


def write_plan_page(plan: Plan, path: Path) -> None:
    """Write the page."""
    pairs = correlations(plan)
    correlated = (f"Correlations of the estimates: {pairs}.",) if pairs else ()
    warnings = (Section("Mind", tuple(map(sentence, plan.warnings))),) if plan.warnings else ()
    Page(
        title="What planned tests would show",
        verdict=plan_verdict(plan),
        lead="Asked of the strain histories, the noise and a guess of the law, before any test is done.",
        sections=(
            Section("How well the parameters would be known", (parameter_table(plan), *correlated)),
            *effect_sections(plan.isolability),
            Section("The tests", (tests_table(plan),)),
            *warnings,
        ),
        provenance=provenance(seed=plan.seed),
    ).write(path)
