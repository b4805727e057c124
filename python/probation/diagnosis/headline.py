"""A diagnosis in one sentence."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.diagnosis.result import UNKNOWN
from probation.effects.registry import effect
from probation.wording import listed, percent

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.closure import Closure
    from probation.diagnosis.result import Explanation, Verdict

MOST_RIVALS = 3


def title(name: str) -> str:
    """An effect's name for people."""
    return "an effect outside the catalogue" if name == UNKNOWN else effect(name).title


def titles(effects: Sequence[str]) -> str:
    """A set of effects for people, what is known of it first."""
    known_first = sorted(effects, key=lambda name: name == UNKNOWN)
    return listed([title(name) for name in known_first], "and") if effects else "no effect"


def choices(sets: Sequence[Sequence[str]]) -> str:
    """Several sets of effects for people, each once; one of several effects stands in brackets."""
    names = [titles(effects) if len(effects) < 2 else f"({titles(effects)})" for effects in sets]
    return listed(list(dict.fromkeys(names)), "or")


def headline(
    verdict: Verdict,
    explanations: Sequence[Explanation],
    answer_set: Sequence[tuple[str, ...]],
    identify: Closure,
    record_count: int,
    p_value: float,
) -> str:
    """One sentence a person can act on."""
    best = explanations[0]
    records = "the one record" if record_count == 1 else f"all {record_count} records"
    if verdict == "no_gap":
        return (
            f"No gap: the law describes {records} to within the noise of {identify.noise_MPa:.2g} MPa "
            f"(p = {p_value:.2g})."
        )
    place = f" in {listed(best.records, 'and')}" if _confined(best, record_count) else ""
    known = [name for name in best.effects if name != UNKNOWN]
    fall = (
        f"the misfit falls from {identify.before_MPa:.3g} to {identify.after_MPa:.3g} MPa, "
        f"the noise being {identify.noise_MPa:.2g} MPa"
    )
    if verdict == "unexplained":
        gap = f"The law misses the records by {identify.before_MPa:.3g} MPa (noise {identify.noise_MPa:.2g} MPa)"
        if known:
            verb = "is" if len(known) == 1 else "are"
            part = f"{titles(known)}{place} {verb} part of it ({fall})"
            return f"{gap}: {part}, but something outside the catalogue is left."
        return f"{gap} and nothing in the catalogue explains it."
    verb, pronoun = ("explains", "it") if len(best.effects) == 1 else ("explain", "them")
    sentence = f"{titles(best.effects).capitalize()}{place} {verb} the gap: with {pronoun} {fall}"
    rivals = [each for each in answer_set if each != best.effects]
    if rivals:
        shown = choices(rivals[:MOST_RIVALS])
        more = f" (and {len(rivals) - MOST_RIVALS} more)" if len(rivals) > MOST_RIVALS else ""
        return f"{sentence}; these tests cannot tell {pronoun} from {shown}{more}."
    return f"{sentence} (probability {percent(best.probability)})."


def _confined(best: Explanation, record_count: int) -> bool:
    return 0 < len(best.records) < record_count
