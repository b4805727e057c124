"""What tests could say of each effect, as a table; and of all, as text."""

from __future__ import annotations

import re
from typing import TYPE_CHECKING

from probation.report.diagnosis_words import count_text
from probation.report.table import Table
from probation.settings.design import DESIGN
from probation.wording import listed, percent

if TYPE_CHECKING:
    from probation.design.isolability_result import EffectIsolability, Isolability
    from probation.diagnosis.isolability import CampaignIsolability

HOW_TO_READ = (
    "Every effect is taken at its usual size. Seen: how far its signal stands above the noise, in standard deviations, "
    f"after the base law has been refitted; {DESIGN.detected:g} are needed. Hidden: the part of the signal that the "
    "parameters of the base law, refitted, take up."
)

_STATUS = {
    "named": "seen and named",
    "ambiguous": "seen, but may be taken for another",
    "too_small": "too small to be seen",
    "absorbed": "hides in the base parameters",
    "without_signal": "does nothing in these records",
}
_RIVALS = 2


def in_words(text: str, isolability: Isolability) -> str:
    """A sentence of the analysis with the titles of effects in place of their names."""
    for effect in isolability.effects:
        text = re.sub(rf"\b{effect.name}\b", effect.title, text)
    return text


def isolability_table(isolability: Isolability) -> Table:
    """Every effect: whether these tests would see it, and what it may be taken for; those that are named first."""
    order = list(_STATUS)
    rows = tuple(
        (effect.title, _answer(effect, isolability), count_text(effect.detectability), percent(effect.absorbable))
        for effect in sorted(
            isolability.effects, key=lambda effect: (order.index(effect.status), -effect.detectability)
        )
    )
    return Table(("effect", "these tests", "seen", "hidden"), rows, "What these tests could say of each effect", left=2)


def isolability_summary(answer: CampaignIsolability) -> str:
    """The headline, then every effect."""
    headline = f"{answer.campaign}: {in_words(answer.found.headline, answer.found)}"
    return "\n\n".join([headline, isolability_table(answer.found).text(), HOW_TO_READ])


def _answer(effect: EffectIsolability, isolability: Isolability) -> str:
    if effect.status != "ambiguous":
        return _STATUS[effect.status]
    titles = {other.name: other.title for other in isolability.effects}
    rivals = [titles[name] for name in effect.rivals]
    more = [f"{len(rivals) - _RIVALS} more"] if len(rivals) > _RIVALS else []
    return f"may be taken for {listed(rivals[:_RIVALS] + more)}"
