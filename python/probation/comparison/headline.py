"""A comparison in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.wording import chance

if TYPE_CHECKING:
    from probation.comparison.result import ChangedParameter, ChangeExplanation


def named(each: ChangeExplanation) -> str:
    """An explanation's name."""
    if not each.effects:
        return "nothing changed"
    words = [
        "something that no known change does" if name == "unknown" else name.replace("_", " ") for name in each.effects
    ]
    return " and ".join(sorted(words, key=lambda word: word.startswith("something")))


def headline(best: ChangeExplanation, count: int, reference: str, *, left: bool = False) -> str:
    """One sentence; `left` says that the change leaves more than noise."""
    probable = f"(probability {chance(best.probability)})"
    if not best.effects:
        return f"Nothing changed since {reference} {probable}."
    where = "all records" if len(best.records) == count and count > 1 else ", ".join(best.records)
    sizes = "; ".join(sized(parameter) for parameter in best.parameters[:3])
    more = "; it leaves more than noise" if left and "unknown" not in best.effects else ""
    return f"Since {reference}: {named(best)} in {where} {probable}" + (f": {sizes}" if sizes else "") + f"{more}."


def sized(each: ChangedParameter) -> str:
    """A size with its interval."""
    low, high = each.interval95
    return f"{each.name} = {each.value:.3g} (95 %: {low:.3g} to {high:.3g})"
