"""How probable every explanation is: evidence times what was probable beforehand."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import e, exp, log
from typing import TYPE_CHECKING, Protocol, TypeVar

import numpy as np
from scipy.special import logsumexp, softmax

from probation.diagnosis.trust import Tempered, log_prior
from probation.inference.candidate import Key
from probation.inference.unknown import UNKNOWN
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Collection, Mapping, Sequence
    from collections.abc import Set as AbstractSet

    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.trust import Trust
    from probation.effects.effect import Effect


class HasProbability(Protocol):
    """Anything with a probability."""

    @property
    def probability(self) -> float:
        """From 0 to 1."""


class HasEffects(HasProbability, Protocol):
    """Anything that names effects, with the probability that these act, and no others."""

    @property
    def effects(self) -> tuple[str, ...]:
        """Names."""


Probable = TypeVar("Probable", bound=HasProbability)

AT_ITS_WORD = Tempered()


@dataclass(frozen=True, eq=False)
class Weighed:
    """An explanation's probability and the hypothesis that stands for it.

    Attributes
    ----------
    effects : tuple of str
        As in docs/formats.md: empty for none, with "unknown" where there is one.
    probability : float
    hypothesis : Hypothesis
        The form and place with the most evidence.
    log_evidence : float or None
        Natural logarithm of its evidence over that of the base law alone, all forms and places together, before it is
        taken to a power and weighed with what was probable beforehand; None where nothing was fitted.
    """

    effects: tuple[str, ...]
    probability: float
    hypothesis: Hypothesis
    log_evidence: float | None = None


def probabilities_of(hypotheses: Sequence[Hypothesis], count: int, trust: Trust = AT_ITS_WORD) -> list[Weighed]:
    """Probabilities of all explanations, most probable first.

    Parameters
    ----------
    hypotheses : sequence of Hypothesis
        The base law's first; several forms and places of the same effects are summed.
    count : int
        Of the catalogue.
    trust : Trust
    """
    together: dict[tuple[str, ...], list[tuple[float, Hypothesis]]] = {}
    for hypothesis in _best_starts(hypotheses):
        value = hypothesis.evidence.log_evidence
        inside = hypothesis.log_share
        for effects, score in (
            (hypothesis.effects, value),
            (with_unknown(hypothesis.effects), hypothesis.evidence.log_evidence_unknown),
        ):
            if np.isfinite(score):  # else it was not tried
                together.setdefault(effects, []).append((score + inside, hypothesis))
    evidence = {effects: float(logsumexp([score for score, _ in entries])) for effects, entries in together.items()}
    odds = {effects: _log_odds(entries[0][1]) for effects, entries in together.items()}
    weighed = [
        Weighed(effects, chance, _standing_for(together[effects]), evidence[effects] - evidence[()])
        for effects, chance in chances_of(evidence, odds, count, trust).items()
    ]
    return sorted(weighed, key=lambda explanation: -explanation.probability)


def chances_of(
    log_evidence: Mapping[tuple[str, ...], float],
    log_odds: Mapping[tuple[str, ...], float],
    count: int,
    trust: Trust,
) -> dict[tuple[str, ...], float]:
    """Probabilities of explanations, in the order of `log_evidence`; arguments as of `Trust.log_weights`."""
    chances = softmax(trust.log_weights(log_evidence, log_odds, count))
    return dict(zip(log_evidence, chances.tolist(), strict=True))


def effect_count(effects: Sequence[Effect]) -> int:
    """How many effects share their prior probability, a rare one counted by its odds: others lose nothing to it."""
    return max(round(sum(effect.odds for effect in effects)), 1)


def with_unseen(weighed: Sequence[Weighed], effects: Sequence[Effect]) -> list[Weighed]:
    """The same with pairs of each probable single effect and one that was not tried, since it would gain nothing.

    It stands for the single effect's own hypothesis: nothing is known of the other.

    Parameters
    ----------
    weighed : sequence of Weighed
    effects : sequence of Effect
        All that were considered.
    """
    names, count = [effect.name for effect in effects], effect_count(effects)
    tried = {explanation.effects for explanation in weighed}
    singles = [
        explanation for explanation in weighed if len(explanation.effects) == 1 and explanation.effects[0] in names
    ]
    extended = list(weighed)
    for single in singles:
        if single.probability < EVIDENCE.noted_with_others:
            continue
        for effect in effects:
            pair = tuple(sorted({*single.effects, effect.name}))
            if len(pair) == 2 and pair not in tried:
                odds = (
                    effect.odds
                    * EVIDENCE.unseen_second_effect
                    * exp(log_prior(pair, count) - log_prior(single.effects, count))
                )
                extended.append(Weighed(pair, odds * single.probability, single.hypothesis))
                tried.add(pair)
    return normalised(extended)


def with_untried(
    weighed: Sequence[Weighed], effects: Sequence[Effect], untried: Collection[str], base: Hypothesis
) -> list[Weighed]:
    """The same where a search was ended early: effects that were not refitted to the end keep what they had beforehand.

    That is their share of the prior probability of one effect, known or unknown; the rest is divided among the
    explanations as they stand. Nothing is known of such an effect: none leads.

    Parameters
    ----------
    weighed : sequence of Weighed
        Most probable first.
    effects : sequence of Effect
        All that were considered.
    untried : collection of str
        Names of those that were not refitted to the end.
    base : Hypothesis
        The base law's; it stands for those that were not tried at all.
    """
    if not untried:
        return list(weighed)
    whole = sum(effect.odds for effect in effects) * (1.0 + EVIDENCE.unknown_effect / EVIDENCE.one_effect)
    kept: dict[tuple[str, ...], float] = {
        (effect.name,): effect.odds / whole for effect in effects if effect.name in untried
    }
    tried = 1.0 - sum(kept.values())
    first, *others = [
        replace(each, probability=tried * each.probability + kept.pop(each.effects, 0.0)) for each in weighed
    ]
    others += [Weighed(alone, probability, base) for alone, probability in kept.items()]
    most = first.probability
    rest = [replace(each, probability=min(each.probability, most)) for each in others]
    total = most + sum(each.probability for each in rest)
    mixed = [replace(each, probability=each.probability / total) for each in (first, *rest)]
    return sorted(mixed, key=lambda explanation: -explanation.probability)


def _standing_for(entries: Sequence[tuple[float, Hypothesis]]) -> Hypothesis:
    """Of the forms that are about as probable in the same place, the one that is most nearly exact."""
    best, leading = max(entries, key=lambda entry: entry[0])
    close = [
        hypothesis
        for score, hypothesis in entries
        if score >= best - EVIDENCE.about_as_probable and hypothesis.records == leading.records
    ]
    return max(close, key=lambda hypothesis: hypothesis.evidence.log_evidence_exact)


def with_unknown(effects: tuple[str, ...]) -> tuple[str, ...]:
    """The same effects jointly with one outside the catalogue."""
    return tuple(sorted({*effects, UNKNOWN}))


def given_no_gap(weighed: Sequence[Weighed], p_value: float) -> list[Weighed]:
    """Where no gap is declared: the test's p-value is a datum, too, and no explanation may lead "no effect is needed".

    The test looks for more than the explanations describe, so that a small p-value is evidence against "none" even
    where theirs is not: its odds are multiplied by the ratio of the densities of p, p^(1 - s) / s with
    s = `EVIDENCE.undeclared_gap_power` (Sellke, Bayarri and Berger 2001).

    Parameters
    ----------
    weighed : sequence of Weighed
    p_value : float
        Of the test for a gap.
    """
    none = next(explanation for explanation in weighed if not explanation.effects)
    probability = (
        max(p_value, EVIDENCE.least_p_value) ** (1.0 - EVIDENCE.undeclared_gap_power)
        / EVIDENCE.undeclared_gap_power
        * none.probability
    )
    weighed = normalised(
        [
            replace(explanation, probability=probability) if explanation is none else explanation
            for explanation in weighed
        ]
    )
    most = max(explanation.probability for explanation in weighed)
    return normalised(
        [explanation if explanation.effects else replace(explanation, probability=most) for explanation in weighed]
    )


def given_a_gap(weighed: Sequence[Weighed], p_value: float) -> list[Weighed]:
    """Where a gap is declared, "no effect is needed" keeps no more than the test leaves it.

    That is what its odds beforehand and the least of all ratios of the densities of p, -e p ln p, come to (Sellke,
    Bayarri and Berger 2001). What it loses goes to all others as they stand: a gap that no explanation gains much from
    may be anything, not first of all something outside the catalogue.

    Parameters
    ----------
    weighed : sequence of Weighed
    p_value : float
        Of the test for a gap.
    """
    none = next(explanation for explanation in weighed if not explanation.effects)
    p_value = max(p_value, EVIDENCE.least_p_value)
    odds = -e * p_value * log(p_value) * EVIDENCE.no_effect / (1.0 - EVIDENCE.no_effect)
    most = odds / (1.0 + odds)
    rest = 1.0 - none.probability
    if none.probability <= most or rest <= 0.0:
        return list(weighed)
    return normalised(
        [
            replace(
                explanation, probability=most if explanation is none else (1.0 - most) * explanation.probability / rest
            )
            for explanation in weighed
        ]
    )


def none_behind(weighed: Sequence[Weighed]) -> list[Weighed]:
    """Where a gap is declared something acts: "no effect is needed" changes places with what comes second."""
    first, *others = weighed
    if first.effects or not others:
        return list(weighed)
    return [
        replace(others[0], probability=first.probability),
        replace(first, probability=others[0].probability),
        *others[1:],
    ]


def normalised(weighed: Sequence[Weighed]) -> list[Weighed]:
    """Probabilities over their sum, most probable first."""
    total = sum(explanation.probability for explanation in weighed)
    parts = [replace(explanation, probability=explanation.probability / total) for explanation in weighed]
    return sorted(parts, key=lambda explanation: (-explanation.probability, len(explanation.effects)))


def _best_starts(hypotheses: Sequence[Hypothesis]) -> list[Hypothesis]:
    """Of starts with the same causes, forms and places the best one: most end in one optimum."""
    best: dict[frozenset[Key], Hypothesis] = {}
    for hypothesis in hypotheses:
        key = hypothesis.refit.keys
        if not np.isfinite(hypothesis.evidence.log_evidence):
            continue
        if key not in best or hypothesis.evidence.log_evidence > best[key].evidence.log_evidence:
            best[key] = hypothesis
    return list(best.values())


def answer_set(weighed: Sequence[Weighed], covered: float = EVIDENCE.credible_set) -> tuple[tuple[str, ...], ...]:
    """The most probable explanations that hold so much probability together, best first.

    Compare the model confidence set of Hansen, Lunde and Nason (2011).
    """
    return tuple(explanation.effects for explanation in leading(weighed, covered))


def leading(ranked: Sequence[Probable], covered: float = EVIDENCE.credible_set) -> tuple[Probable, ...]:
    """The first of what is ranked by probability that hold so much of it together."""
    chosen, total = [], 0.0
    for probable in ranked:
        chosen.append(probable)
        total += probable.probability
        if total >= covered:
            break
    return tuple(chosen)


def probability_of_all(effects: AbstractSet[str], explanations: Sequence[HasEffects]) -> float:
    """That all of these effects act, alone or jointly with others."""
    return min(sum(explanation.probability for explanation in explanations if effects <= {*explanation.effects}), 1.0)


def _log_odds(hypothesis: Hypothesis) -> float:
    """Log odds of its effects relative to those of usual ones, each effect once."""
    odds = {cause.effect.name: cause.effect.odds for cause in hypothesis.causes}
    return sum(log(effect_odds) for effect_odds in odds.values())
