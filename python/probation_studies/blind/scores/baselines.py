"""Answers that need no diagnosis: what a score has to be seen beside."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation_studies.blind.scores.answer import UNKNOWN, Answer, Names
from probation_studies.blind.scores.case import Case, oracle_answer

if TYPE_CHECKING:
    from collections.abc import Mapping

Baseline: TypeAlias = Callable[[Sequence[Case]], list[Case]]
"""The same truths with other answers."""

_SHUFFLE_SEED = 20


def majority(cases: Sequence[Case]) -> list[Case]:
    """The same answer to all: every explanation as often as it is true, the most frequent first."""
    counts = Counter(case.explanation for case in cases)
    probability: dict[Names, float] = {(): 0.0, (UNKNOWN,): 0.0}
    probability |= {names: count / len(cases) for names, count in counts.items()}
    first = counts.most_common(1)[0][0]
    same = Answer(probability, {}, (first,), gap=first != ())
    return [replace(case, answer=same) for case in cases]


def oracle(cases: Sequence[Case]) -> list[Case]:
    """What somebody would answer who knows every form and prior and the noise."""
    return [replace(case, answer=oracle_answer(case.truth)) for case in cases]


def shuffled(cases: Sequence[Case]) -> list[Case]:
    """Each answer given to another campaign: what is left is chance, or a leak."""
    order = np.random.default_rng(_SHUFFLE_SEED).permutation(len(cases))
    return [replace(case, answer=cases[other].answer) for case, other in zip(cases, order, strict=True)]


BASELINES: Mapping[str, Baseline] = {"majority": majority, "oracle": oracle, "shuffled": shuffled}
