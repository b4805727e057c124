"""What could be found out by one who is told the forms, the errors and the priors.

Every explanation is linear in its amplitudes: none, one placed cause, two of different names. An amplitude's prior is a
mixture of normals whose detectabilities are 5, 20 and 80, for the sizes that are planted reach from 4 to 100.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.special import ndtr

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.modal import FloatArray

Names: TypeAlias = "tuple[str, ...]"

REPEATS = 200
RESOLVABLE = 0.95
_NONE, _SINGLE, _PAIR, _OUTSIDE = 0.35, 0.3, 0.2, 0.15
_SIZES = 5.0, 20.0, 80.0
_SET = 0.95


@dataclass(frozen=True, eq=False)
class Placed:
    """A cause in a place.

    Attributes
    ----------
    cause, name : str
        The institute's and the catalogue's.
    record : int, optional
        None for all.
    share : float
        Of its cause's prior.
    signal : ndarray, shape (n_all,)
        Whitened, beside the base law, of norm 1.
    """

    cause: str
    name: str
    record: int | None
    share: float
    signal: FloatArray


@dataclass(frozen=True)
class Oracle:
    """What could be found out.

    Attributes
    ----------
    posterior : dict
        Of explanations above 1e-4, names joined by "+".
    right : float
        Part of repeats in which the true explanation leads.
    answer_set : tuple of Names
        The most probable that hold 95 %, for the errors of the records.
    """

    posterior: dict[str, float]
    right: float
    answer_set: tuple[Names, ...]

    @property
    def resolvable(self) -> bool:
        """Whether it leads in 95 % of repeats."""
        return self.right >= RESOLVABLE


def consult(
    random: Generator, candidates: Sequence[Placed], acting: FloatArray, errors: FloatArray, truth: Names, outside: str
) -> Oracle:
    """Weigh all explanations in repeats with errors drawn anew, and once with the records' own.

    Parameters
    ----------
    random : Generator
    candidates : sequence of Placed
    acting, errors : ndarray, shape (n_all,)
        Whitened, beside the base law.
    truth : tuple of str
    outside : str
        Name of what is in no catalogue; it takes part in no pair.
    """
    signals = np.stack([each.signal for each in candidates], axis=1)
    gram = np.clip(signals.T @ signals, -1.0, 1.0)
    values, vectors = np.linalg.eigh(gram)
    root = vectors * np.sqrt(np.maximum(values, 0.0))
    drawn = random.standard_normal((REPEATS, len(candidates))) @ root.T
    scores = signals.T @ acting + np.vstack([signals.T @ errors, drawn])
    beyond = np.array([each.name == outside for each in candidates])
    causes = {each.cause: each.name == outside for each in candidates}
    known = sum(not each for each in causes.values())
    share = np.array([each.share for each in candidates])
    prior = share * np.where(beyond, _OUTSIDE / max(len(causes) - known, 1), _SINGLE / known)
    labels: list[Names] = [(), *((each.name,) for each in candidates)]
    evidence = [np.full((len(scores), 1), np.log(_NONE)), _single(scores) + np.log(prior)]
    i, j = np.triu_indices(len(candidates), 1)
    names = np.array([each.name for each in candidates])
    chosen = (names[i] != names[j]) & ~beyond[i] & ~beyond[j]
    i, j = i[chosen], j[chosen]
    weight = share[i] * share[j]
    evidence.append(_pair(scores, i, j, gram[i, j]) + np.log(_PAIR * weight / weight.sum()))
    labels += [(min(a, b), max(a, b)) for a, b in zip(names[i].tolist(), names[j].tolist(), strict=True)]
    explanations, table = _summed(labels, np.hstack(evidence))
    at = explanations.index(truth) if truth in explanations else -1
    order = np.argsort(-table[0])
    enough = int(np.searchsorted(np.cumsum(table[0][order]), _SET)) + 1
    return Oracle(
        posterior={"+".join(explanations[k]): float(table[0, k]) for k in order if table[0, k] > 1e-4},
        right=float(np.mean(table[1:].argmax(axis=1) == at)),
        answer_set=tuple(explanations[k] for k in order[:enough]),
    )


def _single(scores: FloatArray) -> FloatArray:
    squares = np.square(_SIZES)[:, None, None]
    each = 0.5 * scores**2 * squares / (1.0 + squares) - 0.5 * np.log1p(squares)
    return np.asarray(np.logaddexp.reduce(each, axis=0) - np.log(len(_SIZES)))


def _pair(scores: FloatArray, i: np.ndarray, j: np.ndarray, cosine: FloatArray) -> FloatArray:
    """Of two normal amplitudes: the data's products a, b; 1/s^2, 1/t^2 added to a Gram matrix with ones."""
    a, b = scores[:, i], scores[:, j]
    total = np.full(a.shape, -np.inf)
    for s in _SIZES:
        for t in _SIZES:
            first, second = 1.0 + s**-2, 1.0 + t**-2
            determinant = first * second - cosine**2
            gain = 0.5 * (second * a**2 + first * b**2 - 2.0 * cosine * a * b) / determinant
            np.logaddexp(total, gain - 0.5 * np.log(determinant) - np.log(s * t), out=total)
    return np.asarray(total - 2.0 * np.log(len(_SIZES)))


def _summed(labels: Sequence[Names], evidence: FloatArray) -> tuple[list[Names], FloatArray]:
    """Probabilities of explanations, whatever their places, (n_scores, n_explanations)."""
    probability = np.exp(evidence - evidence.max(axis=1, keepdims=True))
    probability /= probability.sum(axis=1, keepdims=True)
    explanations = sorted(set(labels))
    place = {names: k for k, names in enumerate(explanations)}
    table = np.zeros((len(explanations), len(evidence)))
    np.add.at(table, [place[names] for names in labels], probability.T)
    return explanations, table.T


def discriminability(size: float, cosine: float) -> float:
    """How often a signal of that size is nearer to itself than to another of that cosine, whatever their amplitudes."""
    half = 0.5 * np.arccos(min(abs(cosine), 1.0))
    near, far = size * np.sin(half), size * np.cos(half)
    return float(ndtr(near) * ndtr(far) + ndtr(-near) * ndtr(-far))
