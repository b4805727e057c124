"""What somebody could tell who knows every form, the true one among them, its prior and the noise.

Signals are columns of norm one in the space of `sight`. A cause in one placement and form has an amplitude that is
normal with a standard deviation of one of several detectabilities; its evidence over that of no cause is closed, and
averaged over these. For pairs of one amplitude each,

    P(i beats j) = Phi(t sin(psi/2)) Phi(t cos(psi/2)) + Phi(-t sin(psi/2)) Phi(-t cos(psi/2)),

psi the angle between the two signals and t = sqrt(lambda), is distinguished from every other cause.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from math import erf, sqrt

import numpy as np

from probation_studies.blind.laboratories.industry.memory import FloatArray

_SIZES = np.array([3.0, 8.0, 25.0, 80.0, 250.0])
_PAIR_SIZES = np.array([6.0, 40.0, 200.0])
_NONE, _PAIRS, _UNKNOWN = 0.4, 0.15, 0.15
_REPEATS, _PAIRED, _SURE = 200, 12, 0.95


@dataclass(frozen=True, eq=False)
class Column:
    """One cause in one form, in some records.

    Attributes
    ----------
    cause, effect : str
        This laboratory's name, and the catalogue's ("unknown" where it has none).
    records : tuple of int
    signal : ndarray, shape (n_all,)
        Whitened, projected, of norm one.
    """

    cause: str
    effect: str
    records: tuple[int, ...]
    signal: FloatArray

    @property
    def place(self) -> tuple[str, tuple[int, ...]]:
        """Cause and records."""
        return self.cause, self.records


def consult(
    random: np.random.Generator, columns: Sequence[Column], clean: FloatArray, truth: tuple[str, ...], acting: int
) -> dict[str, object]:
    """Posterior of one draw, part of repeats in which the truth leads, smallest set of 90 %.

    Parameters
    ----------
    random : Generator
    columns : sequence of Column
        The true ones last.
    clean : ndarray, shape (n_all,)
        Signal of all that acts.
    truth : tuple of str
    acting : int
        How many of the last columns are true.
    """
    signals = np.stack([each.signal for each in columns], axis=1)
    gram = signals.T @ signals
    root = np.linalg.cholesky(gram + 1e-9 * np.eye(len(gram)))
    seen = (signals.T @ clean)[:, None] + root @ random.standard_normal((len(gram), _REPEATS + 1))
    weights: dict[tuple[str, ...], FloatArray] = {(): np.full(_REPEATS + 1, np.log(_NONE))}

    def add(names: tuple[str, ...], log_weight: FloatArray) -> None:
        weights[names] = np.logaddexp(weights[names], log_weight) if names in weights else log_weight

    single = _single(seen)
    known = sorted({each.effect for each in columns} - {"unknown"})
    places = {each.place for each in columns}
    for column, evidence in zip(columns, single, strict=True):
        inside = column.effect != "unknown"
        prior = (1.0 - _NONE - _PAIRS - _UNKNOWN) / len(known) if inside else _UNKNOWN
        rivals = len(
            {place for place in places if any(c.place == place and c.effect == column.effect for c in columns)}
        )
        forms = sum(each.place == column.place for each in columns)
        add((column.effect,), evidence + np.log(prior / rivals / forms))
    strongest = np.argsort(-np.max(np.abs(seen), axis=1))
    telling = list(range(len(columns) - acting, len(columns)))
    for k in strongest:
        if len(telling) < _PAIRED + acting and all(columns[k].place != columns[j].place for j in telling):
            telling.append(int(k))
    telling = [k for k in telling if columns[k].effect != "unknown"]
    count = len(known) * (len(known) - 1) / 2.0
    for i, j in combinations(telling, 2):
        if columns[i].effect != columns[j].effect:
            names = tuple(sorted((columns[i].effect, columns[j].effect)))
            add(names, _pair(seen[i], seen[j], float(gram[i, j])) + np.log(_PAIRS / max(count, 1.0) / 3.0))
    names_of = list(weights)
    table = np.stack([weights[names] for names in names_of])
    right = float(np.mean([names_of[k] == truth for k in np.argmax(table[:, 1:], axis=0)]))
    posterior = np.exp(table[:, 0] - table[:, 0].max())
    posterior /= posterior.sum()
    order = np.argsort(-posterior)
    enough = int(np.searchsorted(np.cumsum(posterior[order]), 0.9)) + 1
    return {
        "posterior": {"+".join(names_of[k]): float(posterior[k]) for k in order if posterior[k] > 1e-4},
        "right": right,
        "answer_set": [list(names_of[k]) for k in order[:enough]],
        "resolvable": right >= _SURE,
    }


def _single(seen: FloatArray) -> FloatArray:
    squares = _SIZES[:, None, None] ** 2
    evidence = 0.5 * seen[None] ** 2 * squares / (1.0 + squares) - 0.5 * np.log1p(squares)
    return np.asarray(np.logaddexp.reduce(evidence, axis=0) - np.log(len(_SIZES)))


def _pair(one: FloatArray, other: FloatArray, cosine: float) -> FloatArray:
    found = []
    for s in _PAIR_SIZES:
        for t in _PAIR_SIZES:
            matrix = np.array([[1.0 + s * s, cosine * s * t], [cosine * s * t, 1.0 + t * t]])
            inverse = np.linalg.inv(matrix)
            a, b = s * one, t * other
            gain = inverse[0, 0] * a * a + 2.0 * inverse[0, 1] * a * b + inverse[1, 1] * b * b
            found.append(0.5 * gain - 0.5 * np.log(np.linalg.det(matrix)))
    return np.asarray(np.logaddexp.reduce(found, axis=0) - np.log(len(found)))


def beats(size: float, cosine: float) -> float:
    """P(i beats j) of two signals of one amplitude each."""
    half = 0.5 * np.arccos(min(abs(cosine), 1.0))
    one, other = size * np.sin(half), size * np.cos(half)
    return _normal(one) * _normal(other) + _normal(-one) * _normal(-other)


def _normal(x: float) -> float:
    return 0.5 * (1.0 + erf(float(x) / sqrt(2.0)))


def left_by(columns: Sequence[Column], clean: FloatArray) -> float:
    """Norm that is left of a signal when these columns have taken their part."""
    basis, _ = np.linalg.qr(np.stack([column.signal for column in columns], axis=1))
    return float(np.linalg.norm(clean - basis @ (basis.T @ clean)))
