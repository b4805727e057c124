"""A comparison in one sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.inference.unknown import UNKNOWN
from probation.settings.evidence import EVIDENCE
from probation.wording import chance, percent

if TYPE_CHECKING:
    from probation.comparison.result import ChangedParameter, ChangeExplanation
    from probation.diagnosis.attribution import Attribution


def named(each: ChangeExplanation) -> str:
    """An explanation's name."""
    if not each.effects:
        return "nothing changed"
    words = [
        "something that no known change does" if name == "unknown" else name.replace("_", " ") for name in each.effects
    ]
    return " and ".join(sorted(words, key=lambda word: word.startswith("something")))


def headline(best: ChangeExplanation, parts: Attribution, count: int, reference: str, *, left: bool = False) -> str:
    """One sentence, with the effects that close nearly all of the gap; `left` says that more than noise is left."""
    if not best.effects:
        return f"Nothing changed since {reference} (probability {chance(best.probability)})."
    all_told = UNKNOWN in best.effects or {*best.effects} <= {*parts.named, *parts.undivided}
    told = best if all_told else _told(best, parts)
    where = "all records" if len(told.records) == count and count > 1 else ", ".join(told.records)
    text = f"Since {reference}: {named(told)} in {where} (probability {chance(told.probability)})"
    if told.parameters:
        text += ": " + "; ".join(sized(parameter) for parameter in told.parameters[:3])
    if not all_told:
        text += f"; what else is in the explanation adds less than {percent(EVIDENCE.share_worth_naming)} of the gap"
    return text + ("; it leaves more than noise." if left and UNKNOWN not in best.effects else ".")


def _told(best: ChangeExplanation, parts: Attribution) -> ChangeExplanation:
    """Of the effects that are named."""
    parameters = tuple(parameter for parameter in best.parameters if parameter.effect in parts.named)
    touched = {name for parameter in parameters for name in parameter.records}
    records = tuple(name for name in best.records if name in touched)
    return replace(best, effects=parts.named, records=records, probability=parts.probability, parameters=parameters)


def sized(each: ChangedParameter) -> str:
    """A size with its interval."""
    low, high = each.interval95
    return f"{each.name} = {each.value:.3g} (95 %: {low:.3g} to {high:.3g})"
