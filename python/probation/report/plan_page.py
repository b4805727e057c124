"""What planned tests will say, as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.provenance import provenance
from probation.report.isolability_page import effect_sections
from probation.report.page import Page, Section
from probation.report.plan_summary import correlations, parameter_table, plan_verdict, tests_table
from probation.wording import sentence

if TYPE_CHECKING:
    from pathlib import Path

    from probation.design.plan import Plan


def write_plan_page(plan: Plan, path: Path) -> None:
    """Write the page."""
    pairs = correlations(plan)
    told = (f"Correlations of the estimates: {pairs}.",) if pairs else ()
    warnings = (Section("Mind", tuple(map(sentence, plan.warnings))),) if plan.warnings else ()
    Page(
        title="What planned tests would tell",
        verdict=plan_verdict(plan),
        lead="Asked of the strain histories, the noise and a guess of the law, before any test is done.",
        sections=(
            Section("How well the parameters would be known", (parameter_table(plan), *told)),
            *effect_sections(plan.isolability),
            Section("The tests", (tests_table(plan),)),
            *warnings,
        ),
        provenance=provenance(seed=plan.seed),
    ).write(path)
