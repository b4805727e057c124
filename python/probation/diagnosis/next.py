"""The test that best discriminates what a diagnosis leaves open (docs/diagnosis-method.md, section 9)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.design.next_test import helps, next_test
from probation.design.predicted import Weighing
from probation.diagnosis.result import NextTest
from probation.inference.unknown import UNKNOWN
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation.design.next_test import RankedTest
    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.diagnosis.trust import Trust
    from probation.inference.base_fit import BaseFit


def is_stretched(base: BaseFit) -> bool:
    """Whether any record is: the tests that can be planned are tension tests."""
    return any(float(np.max(view.recorded_strain)) > 0.0 for view in base.model.views)


def next_test_of(
    base: BaseFit,
    weighed: Sequence[Weighed],
    answer_set: Sequence[tuple[str, ...]],
    hypotheses: Sequence[Hypothesis],
    trust: Trust,
    *,
    threads: int,
    seed: int,
    progress: Callable[[float], None] | None = None,
) -> tuple[NextTest, ...]:
    """Tests to do next, the most worth first; none where one explanation, or none that could be predicted, is left.

    Parameters
    ----------
    base : BaseFit
    weighed : sequence of Weighed
        All explanations.
    answer_set : sequence of tuple of str
    hypotheses : sequence of Hypothesis
        All forms and places that were refitted.
    trust : Trust
        How far the evidence of records counts, those to come as those that there are.
    threads, seed : int
    progress : callable, optional
        Called with the fraction done, 0 to 1.
    """
    open_still = [
        explanation
        for explanation in weighed
        if explanation.effects in answer_set and UNKNOWN not in explanation.effects
    ][: DESIGN.planned_explanations]
    if len(open_still) < 2:
        return ()
    entries, log_evidence, least = [], [], DESIGN.least_form_weight
    for explanation in open_still:
        best = explanation.hypothesis.evidence.log_evidence
        close = [
            other
            for other in hypotheses
            if other.effects == explanation.effects and other.evidence.log_evidence > best - DESIGN.forms_within
        ]
        close = sorted(close, key=lambda other: -other.evidence.log_evidence)[: DESIGN.forms]
        weight = np.exp([other.evidence.log_evidence - best for other in close])
        kept = [(each, part) for each, part in zip(close, weight / weight.sum(), strict=True) if part > least]
        entries += [
            (each.refit.model, each.refit.parameters, float(explanation.probability * part), explanation.effects)
            for each, part in kept
        ]
        log_evidence += [each.evidence.log_evidence for each, _ in kept]
    recommendation = next_test(
        base.model,
        entries,
        noises=base.whitened.noises,
        weighing=Weighing(np.array(log_evidence), trust.fall),
        threads=threads,
        seed=seed,
        progress=progress,
    )
    return () if recommendation is None else as_answer(recommendation.ranking, recommendation.probability_before)


def as_answer(ranking: Sequence[RankedTest], before: float) -> tuple[NextTest, ...]:
    """The best test of every kind that helps, the most worth first; the best of all in any case."""
    of_kind: dict[str, RankedTest] = {}
    for ranked in ranking:
        of_kind.setdefault(ranked.test.name, ranked)
    first, *others = of_kind.values()
    helpful = [ranked for ranked in others if helps(ranked.probability_after, before)]
    return tuple(
        NextTest(
            what=ranked.what,
            separates=tuple(tuple(names) for names in ranked.separates),
            probability_before=before,
            probability_after=ranked.probability_after,
            cost=ranked.test.cost,
        )
        for ranked in (first, *helpful[: DESIGN.listed_tests - 1])
    )


def one_after_the_other(first: tuple[NextTest, ...], others: tuple[NextTest, ...]) -> tuple[NextTest, ...]:
    """Tests for two questions: those that help with the first, then with the other; the first of all if none does."""
    if not (first and others):
        return first or others
    both = (*first, *others)
    helpful = tuple(each for each in both if helps(each.probability_after, each.probability_before))
    return helpful or both[:1]
