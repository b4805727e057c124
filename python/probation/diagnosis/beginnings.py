"""Which candidates a search refits: those that promise something, every form and place at its best starts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.candidate import cause_key
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.inference.candidate import Candidate, Key


def first_of_each(candidates: Sequence[Candidate]) -> list[Candidate]:
    """The best start of every form and placement; of placements in one record the best few."""
    chosen: list[Candidate] = []
    seen: set[Key] = set()
    alone: dict[tuple[str, str], int] = {}
    for candidate in candidates:
        key = cause_key(candidate.cause)
        if key in seen:
            continue
        if candidate.cause.records is not None:
            if alone.get(key[:2], 0) >= SEARCH.places:
                continue
            alone[key[:2]] = alone.get(key[:2], 0) + 1
        seen.add(key)
        chosen.append(candidate)
    return chosen


def promising(candidates: Sequence[Candidate]) -> list[Candidate]:
    """Those whose linearised gain is not hopelessly below the best one's.

    Of a weak gap the linearised model says all; of a strong one it says at least where a search would not even begin.
    """
    least = _least_promising(candidates)
    return [candidate for candidate in candidates if candidate.gain >= least and candidate.gain > 0.0]


def _least_promising(candidates: Sequence[Candidate]) -> float:
    best = max((candidate.gain for candidate in candidates), default=0.0)
    strong = best / (best + SEARCH.strong_gap) if best > 0.0 else 0.0
    return best - max(SEARCH.race_gain, (1.0 - SEARCH.race_fraction) * strong * best)


def further_starts(candidates: Sequence[Candidate], first: Sequence[Candidate], count: int) -> list[Candidate]:
    """Further starts of the same causes."""
    given = {id(candidate) for candidate in first}
    wanted = {cause_key(candidate.cause) for candidate in first}
    many: dict[Key, int] = {}
    further = []
    for candidate in candidates:
        key = cause_key(candidate.cause)
        if id(candidate) in given or key not in wanted or many.get(key, 0) >= count:
            continue
        many[key] = many.get(key, 0) + 1
        further.append(candidate)
    return further


def each_alone(candidates: Sequence[Candidate]) -> list[tuple[Candidate, ...]]:
    """Each to be added by itself."""
    return [(candidate,) for candidate in candidates]


def in_several(candidates: Sequence[Candidate]) -> list[tuple[Candidate, ...]]:
    """Of each effect its starts in all records where it gains: what acts in several is not quite alike in them.

    Specimens have sections of their own, and a slip its own instant. So each record has its own best start, and its own
    best smooth one: a step is far from what takes its time. And once more all have the same form from the same values,
    those that gain most together: a start that is best in one record by itself may be far from what acts there.
    """
    best: dict[tuple[str, bool], dict[tuple[str, ...], Candidate]] = {}
    alike: dict[tuple[str, str, tuple[float, ...]], dict[tuple[str, ...], Candidate]] = {}
    for candidate in candidates:
        cause = candidate.cause
        if not cause.form.several:
            continue
        if candidate.base is None and cause.records is not None and candidate.gain > SEARCH.worth_refitting:
            for smooth in {False, cause.form.sharp is None}:
                best.setdefault((cause.effect.name, smooth), {}).setdefault(cause.records, candidate)
            start = cause.effect.name, cause.form.name, candidate.values[1:]
            alike.setdefault(start, {}).setdefault(cause.records, candidate)
    groups: list[tuple[Candidate, ...]] = []
    for (name, smooth), own in best.items():
        starts = [tuple(places.values()) for (effect, *_), places in alike.items() if effect == name]
        for together in (tuple(own.values()), *([] if smooth else [max(starts, key=gain_together)])):
            if len(together) > 1 and together not in groups:
                groups.append(together)
    return groups


def promising_in_several(candidates: Sequence[Candidate]) -> list[tuple[Candidate, ...]]:
    """Those in several records that together gain more than their effect does in one size, or in one record.

    They are no further behind than a promising single one.
    """
    least = _least_promising(candidates)
    alone: dict[str, float] = {}
    for candidate in candidates:
        alone.setdefault(candidate.cause.effect.name, candidate.gain)
    return [
        together
        for together in in_several(candidates)
        if gain_together(together) >= max(least, alone[together[0].cause.effect.name])
    ]


def gain_together(together: Sequence[Candidate]) -> float:
    """What candidates in different records gain, each by itself: about what they gain together."""
    return sum(candidate.gain for candidate in together)


def forms_of_the_best(candidates: Sequence[Candidate], count: int) -> list[Candidate]:
    """The best start of every form of each of the best effects; in all records and in one count apart."""
    effects = list(
        dict.fromkeys((candidate.cause.effect.name, candidate.cause.records is None) for candidate in candidates)
    )[:count]
    best: dict[tuple[str, bool, str], Candidate] = {}
    for candidate in candidates:
        effect = candidate.cause.effect.name, candidate.cause.records is None
        if effect in effects:
            best.setdefault((*effect, candidate.cause.form.name), candidate)
    return list(best.values())
