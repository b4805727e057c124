"""What could have been found out by one who knows forms, errors and priors: evidence of signals linear in amplitude."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.stats import norm

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray

Names: TypeAlias = "tuple[str, ...]"

REPEATS = 200
RESOLVABLE = 0.95
_PRIOR_NONE, _PRIOR_SINGLE, _PRIOR_PAIR, _PRIOR_OUTSIDE = 0.35, 0.35, 0.2, 0.1
_UNSEEN = 1e-6
"""Norm of a signal, over the largest one's, below which it is round-off."""

_USUAL = 15.0
"""Detectability at one standard deviation of a cause's prior."""


@dataclass(frozen=True)
class Candidate:
    """A placed cause.

    Attributes
    ----------
    kind, effect : str
        The laboratory's name of the cause and the one that it goes by.
    share : float
        Of its cause's prior.
    outside : bool
    """

    kind: str
    effect: str
    share: float
    outside: bool


@dataclass(frozen=True)
class Oracle:
    """What could have been found out.

    Attributes
    ----------
    posterior : dict
        Of explanations, names joined by "+"; "" for none; those above 1e-4.
    right : float
        Part of repeats in which the best explanation is the true one.
    answer_set : tuple of Names
        The most probable that hold 95 %.
    """

    posterior: dict[str, float]
    right: float
    answer_set: tuple[Names, ...]

    @property
    def resolvable(self) -> bool:
        """Whether it is right in 95 % of repeats."""
        return self.right >= RESOLVABLE


def consult(
    random: Generator,
    candidates: Sequence[Candidate],
    gram: FloatArray,
    clean: FloatArray,
    observed: FloatArray,
    truth: Names,
) -> Oracle:
    """Weigh none, every candidate and every pair of them.

    Parameters
    ----------
    random : Generator
    candidates : sequence of Candidate
    gram : ndarray, shape (n, n)
        Inner products of their signals.
    clean, observed : ndarray, shape (n,)
        Inner products of their signals with what acts, and with what acts and the errors that were drawn.
    truth : tuple of str
    """
    norms = np.sqrt(np.maximum(np.diag(gram), 0.0))
    norms = np.where(norms > _UNSEEN * norms.max(), norms, np.inf)  # no record shows it: a score of 0
    unit = np.clip(gram / np.outer(norms, norms), -1.0, 1.0)
    values, vectors = np.linalg.eigh(unit)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    repeats = clean / norms + random.standard_normal((REPEATS, len(norms))) @ root.T
    scores = np.vstack([observed / norms, repeats])  # (1 + REPEATS, n)
    explanations, sums = _posterior(candidates, unit, scores)
    best = sums[1:].argmax(axis=1)
    at = explanations.index(truth) if truth in explanations else -1
    order = np.argsort(-sums[0])
    count = int(np.searchsorted(np.cumsum(sums[0][order]), 0.95)) + 1
    return Oracle(
        posterior={"+".join(explanations[k]): float(sums[0][k]) for k in order if sums[0][k] > 1e-4},
        right=float(np.mean(best == at)),
        answer_set=tuple(explanations[k] for k in order[:count]),
    )


def _posterior(candidates: Sequence[Candidate], unit: FloatArray, scores: FloatArray) -> tuple[list[Names], FloatArray]:
    """Explanations and their probabilities, (n_scores, n_explanations), from signals of norm 1."""
    n = len(candidates)
    precision = 1.0 / _USUAL**2
    inside = len({candidate.kind for candidate in candidates if not candidate.outside})
    beyond = max(len({candidate.kind for candidate in candidates if candidate.outside}), 1)
    prior = np.array(
        [
            candidate.share * (_PRIOR_OUTSIDE / beyond if candidate.outside else _PRIOR_SINGLE / inside)
            for candidate in candidates
        ]
    )
    single = 0.5 * scores**2 / (1.0 + precision) + 0.5 * np.log(precision / (1.0 + precision)) + np.log(prior)
    first, second = np.triu_indices(n, 1)
    kinds = np.array([candidate.kind for candidate in candidates])
    apart = kinds[first] != kinds[second]
    beyond_any = np.array([candidate.outside for candidate in candidates])
    apart &= ~(beyond_any[first] | beyond_any[second])
    first, second = first[apart], second[apart]
    cosine, own = unit[first, second], 1.0 + precision
    determinant = own**2 - cosine**2
    a, b = scores[:, first], scores[:, second]
    gain = 0.5 * (own * (a**2 + b**2) - 2.0 * cosine * a * b) / determinant
    weight = prior[first] * prior[second]
    pair = gain + 0.5 * np.log(precision**2 / determinant) + np.log(_PRIOR_PAIR * weight / weight.sum())
    none = np.full((len(scores), 1), np.log(_PRIOR_NONE))
    evidence = np.hstack([none, single, pair])
    evidence -= evidence.max(axis=1, keepdims=True)
    probability = np.exp(evidence)
    probability /= probability.sum(axis=1, keepdims=True)
    names: list[Names] = [(), *((candidate.effect,) for candidate in candidates)]
    names += [
        tuple(sorted({candidates[i].effect, candidates[j].effect}))
        for i, j in zip(first.tolist(), second.tolist(), strict=True)
    ]
    explanations = sorted(set(names))
    place = {name: k for k, name in enumerate(explanations)}
    sums = np.zeros((len(scores), len(explanations)))
    np.add.at(sums.T, [place[name] for name in names], probability.T)
    return explanations, sums


def discriminability(detectability: float, cosine: float) -> float:
    """How often a signal beats another of that cosine, both of unsigned, linear amplitude, known but for that."""
    half = 0.5 * np.arccos(np.clip(abs(cosine), 0.0, 1.0))
    near, far = detectability * np.sin(half), detectability * np.cos(half)
    return float(norm.cdf(near) * norm.cdf(far) + norm.cdf(-near) * norm.cdf(-far))
