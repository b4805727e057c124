"""What each effect has to do with the gap: how probably it acts, and how much of the gap it closes.

docs/diagnosis-method.md, section 8.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, permutations
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.diagnosis.probabilities import probability_of_all
from probation.inference.candidate import cause_key
from probation.inference.refit import Ended, Refit, refit
from probation.inference.unknown import UNKNOWN
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.mean_square import mean_square
from probation.noise.own_deviations import own_deviations
from probation.parallel import in_parallel
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence
    from collections.abc import Set as AbstractSet

    from probation._arrays import FloatArray
    from probation.diagnosis.closure import Closure
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.inference.base_fit import BaseFit
    from probation.inference.problem import Problem


@dataclass(frozen=True)
class EffectShare:
    """One effect's part in the answer.

    Attributes
    ----------
    name : str
        "unknown" for what is outside the catalogue.
    probability : float
        Of the effect being in the right explanation, alone or with others.
    share : float or None
        Of the gap (mean square, the noise set apart) that it closes in the best explanation, or in the nearest one
        where an unknown effect leads alone (`Causes.nearest`): the mean over all orders in which its effects can be
        added (Shapley 1953), those that the headline names before the others. 0 for an effect that is not in it; None
        where the gap is not above `EVIDENCE.closure_gap` standard errors of the noise.
    alone, in_addition : float or None
        What it closes alone, and in addition to all others of the best explanation; None if it is not in it, and where
        there are no shares.
    records : tuple of str
        Ids of those that it touches.
    named : bool
        Whether the headline names it as a cause.
    interchangeable : bool
        Whether another effect of the best explanation can stand in for it, so that its share alone means nothing.
    """

    name: str
    probability: float
    share: float | None
    alone: float | None
    in_addition: float | None
    records: tuple[str, ...]
    named: bool
    interchangeable: bool = False

    def to_dict(self) -> dict[str, Any]:
        """As in `effects` of docs/formats.md."""
        return {
            "name": self.name,
            "probability": self.probability,
            "share": self.share,
            "alone": self.alone,
            "in_addition": self.in_addition,
            "records": list(self.records),
            "named": self.named,
            "interchangeable": self.interchangeable,
        }


@dataclass(frozen=True)
class Attribution:
    """The explanation that goes furthest taken apart: the best one, or `Causes.nearest` where an unknown leads alone.

    Attributes
    ----------
    effects : tuple of EffectShare
        By share, then by probability.
    named : tuple of str
        The smallest part of the best explanation that closes all of what it closes but
        `EVIDENCE.share_worth_naming`, and leaves no more than `EVIDENCE.most_left` times what it leaves, or the
        noise; by share. Effects that can stand in for each other are named, too, where all act with
        `EVIDENCE.credible_set`. All effects where there are no shares, and where these leave more in MPa than
        that, or the misfit falls with these but not with all, or the other way round; none where an unknown
        effect leads alone.
    after_MPa : float
        Root mean square of what the named effects leave.
    probability : float
        That all the named effects are in the right explanation.
    """

    effects: tuple[EffectShare, ...]
    named: tuple[str, ...]
    after_MPa: float  # noqa: N815 - as it leaves the program
    probability: float

    @property
    def undivided(self) -> tuple[str, ...]:
        """Effects of the best explanation that can stand in for each other, the one that closes most alone first."""
        among = [effect for effect in self.effects if effect.interchangeable]
        return tuple(effect.name for effect in sorted(among, key=lambda effect: -(effect.alone or 0.0)))


def attribution(
    base: BaseFit,
    weighed: Sequence[Weighed],
    nearest: Hypothesis,
    found: Sequence[Hypothesis],
    closure: Closure,
    threads: int,
) -> Attribution:
    """Probability and share of every effect.

    Parameters
    ----------
    base : BaseFit
    weighed : sequence of Weighed
        All explanations, the most probable first.
    nearest : Hypothesis
        As far as known effects come, `Causes.nearest`.
    found : sequence of Hypothesis
        All forms and places that were refitted.
    closure : Closure
        Of the nearest, on the records that were fitted.
    threads : int
    """
    best = weighed[0]
    known = nearest.effects if best.effects else ()
    parts = _parts(base, nearest, known, found, threads)
    squares = _squares(base, parts)
    floor = 1.0 if _differ(base) else closure.noise_MPa**2
    named, after = known, closure.after_MPa
    closed: dict[tuple[str, ...], float] = {}
    shares: dict[str, float] = {}
    undivided: tuple[str, ...] = ()
    if _above_noise(base, squares[()], closure):
        gap = squares[()] - min(floor, squares[known])
        closed = {part: (squares[()] - square) / gap for part, square in squares.items()}
        named, undivided = _named(known, closed, squares, floor), _undivided(known, closed)
        if _probability_within({*named, *undivided}, weighed) >= EVIDENCE.credible_set:
            named = tuple(name for name in known if name in {*named, *undivided})
        if len(named) < len(known):
            after = _misfit(base, parts[named])
            most = EVIDENCE.most_left * max(closure.after_MPa, closure.noise_MPa)
            if after > most or (after < closure.before_MPa) != (closure.after_MPa < closure.before_MPa):
                named, after = known, closure.after_MPa
        shares = _shares(named, known, closed)
    if best.effects == (UNKNOWN,):
        named, after = (), closure.before_MPa
    entries = []
    for name in dict.fromkeys([*best.effects, *(name for explanation in weighed for name in explanation.effects)]):
        probability = probability_of_all({name}, weighed)
        inside = name in known and bool(closed)
        if name not in {*best.effects, *known} and probability < EVIDENCE.probability_worth_naming:
            continue
        share = shares.get(name, 0.0) if closed else None
        if name == UNKNOWN and UNKNOWN in best.effects and closed:
            share = max(1.0 - closed[known], 0.0)
        entries.append(
            EffectShare(
                name=name,
                probability=probability,
                share=share,
                alone=closed[(name,)] if inside else None,
                in_addition=closed[known] - closed[_without(known, name)] if inside else None,
                records=_records(name, weighed),
                named=name in named,
                interchangeable=name in undivided,
            )
        )
    entries.sort(key=lambda entry: (-(entry.share or 0.0), -entry.probability))
    return Attribution(
        effects=tuple(entries),
        named=tuple(entry.name for entry in entries if entry.named),
        after_MPa=after,
        probability=probability_of_all({*named}, weighed),
    )


def _probability_within(effects: AbstractSet[str], weighed: Sequence[Weighed]) -> float:
    """That all of them act if nothing outside the catalogue does: an unknown says nothing of which of them act."""
    catalogued = [explanation for explanation in weighed if UNKNOWN not in explanation.effects]
    return probability_of_all(effects, catalogued) / max(
        sum(explanation.probability for explanation in catalogued), 1e-300
    )


def _parts(
    base: BaseFit, best: Hypothesis, known: tuple[str, ...], hypotheses: Sequence[Hypothesis], threads: int
) -> dict[tuple[str, ...], Refit | None]:
    """Refits of law and effects for every part of an explanation, smaller ones first; None if unsolvable."""
    solved = {hypothesis.refit.keys: hypothesis.refit for hypothesis in hypotheses}
    parts = [part for size in range(1, len(known)) for part in combinations(known, size)]

    def begun(part: tuple[str, ...]) -> tuple[Problem, FloatArray | Refit]:
        causes = [cause for cause in best.causes if cause.effect.name in part]
        there = solved.get(frozenset(cause_key(cause) for cause in causes))
        if there is not None:  # its causes may stand in another order
            return base.problem.with_model(there.model), there
        model = best.refit.model.with_causes(causes)
        law, values = best.refit.model.split(best.refit.parameters)
        start = model.parameters(law, *(own for cause, own in values if cause.effect.name in part))
        return base.problem.with_model(model), start

    def fitted(start: tuple[Problem, FloatArray | Refit]) -> Ended | None:
        try:
            return refit(*start).ended
        except UNSOLVABLE:
            return None

    starts = [begun(part) for part in parts]
    refits: dict[tuple[str, ...], Refit | None] = {}
    for part, (problem, start), ended in zip(parts, starts, in_parallel(fitted, starts, threads), strict=True):
        there = start if isinstance(start, Refit) else None
        refits[part] = there if ended is None else Refit.of(problem, ended)
    return {(): base.refit, **refits, known: best.refit if known else base.refit}


def _squares(base: BaseFit, parts: Mapping[tuple[str, ...], Refit | None]) -> dict[tuple[str, ...], float]:
    """Mean square of what every part leaves [MPa^2].

    Where specimens differ, in units of the noise: their deviations are refitted with every part, and only there does a
    part never close more than the whole.
    """
    squares: dict[tuple[str, ...], float] = {}
    for part, fit in parts.items():
        # What cannot be solved closes no more than its own parts do.
        below = [squares[smaller] for smaller in squares if {*smaller} < {*part}]
        squares[part] = _mean_square(base, fit) if fit is not None else min(below)
    return squares


def _mean_square(base: BaseFit, fit: Refit) -> float:
    """Of the errors on the fitted records [MPa^2]; of the whitened ones where specimens differ."""
    if _differ(base):
        return fit.chi_square / len(fit.residual)
    return mean_square(base.residual_of(fit), base.whitened.noises)


def _above_noise(base: BaseFit, square: float, closure: Closure) -> bool:
    """Whether the mean square of the gap, in the units of `_squares`, is plainly above that of the noise."""
    if _differ(base):
        return bool(square - 1.0 > EVIDENCE.closure_gap * np.sqrt(2.0 / len(base.refit.residual)))
    return closure.closure is not None


def _misfit(base: BaseFit, fit: Refit | None) -> float:
    """Root mean square of the errors, each specimen having its own deviations [MPa]."""
    errors = base.residual_of(base.refit if fit is None else fit)
    own = own_deviations(errors, base.whitened.noises)
    left = [error - part for error, part in zip(errors, own, strict=True)]
    return float(np.sqrt(mean_square(left, base.whitened.noises)))


def _differ(base: BaseFit) -> bool:
    """Whether specimens may differ."""
    return any(noise.specimen is not None for noise in base.whitened.noises)


def _shares(
    named: tuple[str, ...], known: tuple[str, ...], closed: Mapping[tuple[str, ...], float]
) -> dict[str, float]:
    """Mean, over the orders in which the named effects come first, of what each effect closes when it is added.

    So the shares of the named ones sum to what these close, and those of the others to what is added to that.
    """
    shares = dict.fromkeys(known, 0.0)
    others = tuple(name for name in known if name not in named)
    orders = [first + then for first in permutations(named) for then in permutations(others)]
    for order in orders:
        before: tuple[str, ...] = ()
        for name in order:
            after = tuple(sorted((*before, name)))
            shares[name] += (closed[after] - closed[before]) / len(orders)
            before = after
    return shares


def _undivided(known: tuple[str, ...], closed: Mapping[tuple[str, ...], float]) -> tuple[str, ...]:
    """Effects each of which alone closes nearly all that the explanation does, if there are several."""
    whole = closed[known]
    alone = {name: closed[(name,)] for name in known}
    stand_ins = sorted(
        (name for name in known if alone[name] >= EVIDENCE.nearly_all * whole), key=lambda name: -alone[name]
    )
    return tuple(stand_ins) if len(stand_ins) > 1 and whole > 0.0 else ()


def _named(
    known: tuple[str, ...],
    closed: Mapping[tuple[str, ...], float],
    squares: Mapping[tuple[str, ...], float],
    floor: float,
) -> tuple[str, ...]:
    """The fewest that close nearly all and leave about as little as all do, or as the noise.

    One percent of the mean square of a gap of 100 times the noise is still ten times the noise.
    """
    most = EVIDENCE.most_left**2 * max(floor, squares[known])
    for size in range(1, len(known)):
        parts = [
            part
            for part in combinations(known, size)
            if closed[part] > closed[known] - EVIDENCE.share_worth_naming and squares[part] <= most
        ]
        if parts:
            return max(parts, key=lambda part: closed[part])
    return known


def _without(known: tuple[str, ...], name: str) -> tuple[str, ...]:
    return tuple(other for other in known if other != name)


def _records(name: str, weighed: Sequence[Weighed]) -> tuple[str, ...]:
    """Those that an effect touches in the most probable explanation that holds it."""
    for explanation in weighed:
        causes = [cause for cause in explanation.hypothesis.causes if cause.effect.name == name]
        if causes:
            views = explanation.hypothesis.refit.model.views
            return tuple(view.id for view in views if any(cause.touches(view.id) for cause in causes))
    return ()
