"""What could be found out by one who is told the forms, the errors and the priors.

Every explanation is linear in its amplitudes: none, one placed cause, two of different names. The logarithm of a
cause's sqrt(lambda) is even over the sizes that are planted, its sign is free; evidence is that of the best amplitudes
in this range, with the width of the likelihood (Laplace).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.special import ndtr

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator
    from numpy.typing import NDArray

    from probation_studies.blind.laboratories.institute.modal import FloatArray

Names: TypeAlias = "tuple[str, ...]"

REPEATS = 200
RESOLVABLE = 0.95
_NONE, _SINGLE, _PAIR, _OUTSIDE = 0.4, 0.3, 0.15, 0.15
_LEAST, _MOST = 3.6, 120.0
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
        Whitened, orthogonal to the base law, of norm 1.
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
        Whitened, orthogonal to the base law.
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


def _possible(amplitude: FloatArray) -> FloatArray:
    """The nearest amplitude that may be planted."""
    return np.asarray(np.copysign(np.clip(np.abs(amplitude), _LEAST, _MOST), amplitude))


def _log_prior(amplitude: FloatArray) -> FloatArray:
    return np.asarray(-np.log(2.0 * np.log(_MOST / _LEAST) * np.abs(amplitude)))


def _single(scores: FloatArray) -> FloatArray:
    a = _possible(scores)
    return np.asarray(a * scores - 0.5 * a**2 + 0.5 * np.log(2.0 * np.pi) + _log_prior(a))


def _pair(scores: FloatArray, i: NDArray[np.intp], j: NDArray[np.intp], cosine: FloatArray) -> FloatArray:
    """One amplitude at its best, then the other jointly with it, both ways round."""
    x, y, square = scores[:, i], scores[:, j], np.maximum(1.0 - cosine**2, 1e-9)
    found = []
    for first, second in ((x, y), (y, x)):
        a = _possible((first - cosine * second) / square)
        b = _possible(second - cosine * a)
        gain = a * first + b * second - 0.5 * (a**2 + b**2) - cosine * a * b
        found.append(gain + _log_prior(a) + _log_prior(b))
    # the likelihood of two signals that are nearly one is wide, but amplitudes end
    width = np.minimum(-0.5 * np.log(square), np.log(_MOST))
    return np.asarray(np.maximum(*found) + np.log(2.0 * np.pi) + width)


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
