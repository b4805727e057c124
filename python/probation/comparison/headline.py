"""A comparison in one sentence."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.diagnosis.headline import adds_little
from probation.diagnosis.probabilities import probability_of_all
from probation.inference.unknown import UNKNOWN
from probation.settings.evidence import EVIDENCE
from probation.wording import chance

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.comparison.result import ChangeExplanation
    from probation.diagnosis.attribution import Attribution


def named(each: ChangeExplanation) -> str:
    """An explanation's name."""
    if not each.effects:
        return "nothing changed"
    words = [
        "something that no known change does" if name == "unknown" else name.replace("_", " ") for name in each.effects
    ]
    return " and ".join(sorted(words, key=lambda word: word.startswith("something")))


def headline(
    explanations: Sequence[ChangeExplanation],
    parts: Attribution | None,
    count: int,
    reference: str,
    *,
    left: bool = False,
    specimens: str = "",
) -> str:
    """One sentence, with the effects that close nearly all of the gap; `left` says that more than noise is left.

    `specimens` is a clause for where nothing changed: how far apart the campaigns are, which specimens may be.

    Parameters
    ----------
    explanations : sequence of ChangeExplanation
        The best one first. What is named acts as probably as all that hold it together.
    parts : Attribution or None
        Of the best explanation; None where all its effects are named.
    """
    best = explanations[0]
    if not best.effects and best.probability < EVIDENCE.even_chance and len(explanations) > 1:
        other = explanations[1]
        return (
            f"Whether anything changed since {reference} cannot be told: nothing did with {chance(best.probability)}, "
            f"{named(other)} with {chance(other.probability)}{specimens}."
        )
    if not best.effects:
        return f"Nothing changed since {reference} (probability {chance(best.probability)}){specimens}."
    shown = best if parts is None else _with_named(best, parts)
    where = "all records" if len(shown.records) == count and count > 1 else ", ".join(shown.records)
    text = f"Since {reference}: {named(shown)} in {where} (probability {chance(_acting(shown, explanations))})"
    if shown.parameters:
        text += ": " + "; ".join(sized(shown, most=3))
    if len(shown.effects) < len(best.effects):
        text += adds_little()
    return text + ("; it leaves more than noise." if left and UNKNOWN not in best.effects else ".")


def _acting(shown: ChangeExplanation, explanations: Sequence[ChangeExplanation]) -> float:
    """That all of these effects act, alone or jointly with others; of an unknown one, that it acts alone."""
    return shown.probability if UNKNOWN in shown.effects else probability_of_all({*shown.effects}, explanations)


def _with_named(best: ChangeExplanation, parts: Attribution) -> ChangeExplanation:
    """Of the effects that are named, and of those that can stand in for one of them."""
    effects = tuple(name for name in best.effects if name in {*parts.named, *parts.undivided})
    if len(effects) == len(best.effects):
        return best
    parameters = tuple(parameter for parameter in best.parameters if parameter.effect in effects)
    touched = {name for parameter in parameters for name in parameter.records}
    records = tuple(name for name in best.records if name in touched)
    return replace(best, effects=effects, records=records, parameters=parameters)


def sized(explanation: ChangeExplanation, most: int | None = None) -> list[str]:
    """Sizes with their intervals, as many as wanted; with its records, where there is another of that name."""
    names = [(each.effect, each.name) for each in explanation.parameters]
    lines = []
    for each in explanation.parameters[:most]:
        low, high = each.interval95
        where = f" in {', '.join(each.records)}" if names.count((each.effect, each.name)) > 1 else ""
        lines.append(f"{each.name} = {each.value:.3g}{where} (95 %: {low:.3g} to {high:.3g})")
    return lines
