"""What a campaign's tests could say of each effect, as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.isolability_table import HOW_TO_READ, in_words, isolability_table

if TYPE_CHECKING:
    from probation.diagnosis.isolability import CampaignIsolability


def isolability_summary(answer: CampaignIsolability) -> str:
    """The headline, then every effect."""
    table = isolability_table(answer.found)
    return "\n\n".join(
        [f"{answer.campaign}: {in_words(answer.found.headline, answer.found)}", table.text(), HOW_TO_READ]
    )
