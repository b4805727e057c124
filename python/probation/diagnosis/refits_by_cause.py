"""Refits by their causes: the least of each set, of each effect, and what parts of them there are."""

from __future__ import annotations

from itertools import product
from typing import TYPE_CHECKING

from probation.inference.candidate import cause_key

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.inference.candidate import Key
    from probation.inference.refit import Refit


def of_one_cause(refits: Iterable[Refit]) -> list[Refit]:
    """Refits of one cause, not of an effect that acts in several records."""
    return [fit for fit in refits if len(fit.model.causes) == 1]


def least_of_each(refits: Iterable[Refit]) -> dict[frozenset[Key], Refit]:
    """Of each set of causes the refit that leaves least."""
    least: dict[frozenset[Key], Refit] = {}
    for fit in refits:
        keys = fit.keys
        if keys not in least or fit.chi_square < least[keys].chi_square:
            least[keys] = fit
    return least


def least_of_each_effect(refits: Sequence[Refit], before: int) -> list[Refit]:
    """Of the forms of each effect that was added to `before` causes, the one that leaves least; in several apart."""
    least: dict[tuple[str, bool, bool], Refit] = {}
    for fit in refits:
        added = fit.model.causes[before:]
        key = added[0].effect.name, added[0].records is None, len(added) > 1
        if key not in least or fit.chi_square < least[key].chi_square:
            least[key] = fit
    return list(least.values())


def with_others_absent(whole: Refit, part: Refit) -> FloatArray:
    """Parameters of the whole at the optimum of a part of its causes: the others' amplitudes are zero."""
    base, values = part.model.split(part.parameters)
    known = {cause_key(cause): own for cause, own in values}
    others = whole.model.split(whole.parameters)[1]
    return whole.model.parameters(base, *(known.get(cause_key(cause), (0.0, *own[1:])) for cause, own in others))


def effects_placed(refit: Refit) -> frozenset[tuple[str, tuple[str, ...] | None]]:
    """The effect of a refit, and where it acts."""
    return frozenset((cause.effect.name, cause.records) for cause in refit.model.causes)


def parts_of(causes: Sequence[Cause]) -> list[tuple[bool, ...]]:
    """Which causes parts of an explanation keep: any of its effects, or all causes but one."""
    names = list(dict.fromkeys(cause.effect.name for cause in causes))
    effects = [dict(zip(names, kept, strict=True)) for kept in product((True, False), repeat=len(names))]
    parts = [tuple(kept[cause.effect.name] for cause in causes) for kept in effects]
    parts += [tuple(other is not cause for other in causes) for cause in causes]
    return [kept for kept in dict.fromkeys(parts) if any(kept) and not all(kept)]
