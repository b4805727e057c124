"""What a campaign's tests could say of each effect, as text."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

from probation.report.diagnosis_summary import WIDTH
from probation.report.isolability_table import HOW_TO_READ, in_words, isolability_table

if TYPE_CHECKING:
    from probation.diagnosis.isolability import CampaignIsolability


def isolability_summary(answer: CampaignIsolability) -> str:
    """The headline, then every effect."""
    table = isolability_table(answer.found).wrapped({"effect": 36, "these tests": 40})
    return "\n\n".join(
        [f"{answer.campaign}: {in_words(answer.found.headline, answer.found)}", table.text(), fill(HOW_TO_READ, WIDTH)]
    )
