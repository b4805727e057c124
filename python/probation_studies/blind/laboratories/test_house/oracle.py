"""What could be found out by one who is told the form, how often causes are drawn, and the noise.

An explanation is nothing, one cause in a place, or two different ones; it is linear in its amplitudes, in the space
that the errors whiten and without what the law takes up. What acts stands there in its own form, shape and place; any
other cause in both of its forms, usual shapes and all places. The logarithm of a cause's sqrt(lambda) is even over
what is let pass, its sign is free; evidence is that of the best amplitudes in this range, times the width of the
likelihood there (Laplace).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation_studies.blind.laboratories.test_house.planting import LEAST_OF_PAIR, MOST, Placed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.modal import FloatArray

Names: TypeAlias = "tuple[str, ...]"

REPEATS = 200
RESOLVABLE = 0.95
_SET = 0.95
NONE, SINGLE, PAIR = 16 / 74, 48 / 74, 10 / 74
"""How often nothing, one cause or two are drawn."""


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
        """Whether the truth leads in 95 % of repeats."""
        return self.right >= RESOLVABLE

    @property
    def said(self) -> dict[str, object]:
        """As a truth has it."""
        answers = [list(names) for names in self.answer_set]
        return {
            "posterior": self.posterior,
            "right": self.right,
            "resolvable": self.resolvable,
            "answer_set": answers,
        }


def consult(
    random: Generator, candidates: Sequence[Placed], acting: FloatArray, errors: FloatArray, truth: Names
) -> Oracle:
    """Weigh all explanations with the records' errors, and in repeats with errors that are drawn anew.

    Parameters
    ----------
    random : Generator
    candidates : sequence of Placed
    acting, errors : ndarray, shape (n_all,)
        Of all that acts, and of the records.
    truth : tuple of str
    """
    signals = np.stack([each.signal / np.linalg.norm(each.signal) for each in candidates], axis=1)
    gram = signals.T @ signals
    values, vectors = np.linalg.eigh(gram)
    drawn = random.standard_normal((REPEATS, len(gram))) @ (vectors * np.sqrt(np.maximum(values, 0.0))).T
    scores = acting @ signals + np.vstack([errors @ signals, drawn])
    names = np.array([each.form.cause for each in candidates])
    share = np.array([each.share for each in candidates])
    first, second = np.triu_indices(len(names), 1)
    differ = names[first] != names[second]
    first, second = first[differ], second[differ]
    both = share[first] * share[second]
    evidence = np.hstack(
        [
            np.full((len(scores), 1), np.log(NONE)),
            _one(scores) + np.log(SINGLE * share / len(set(names.tolist()))),
            _two(scores[:, first], scores[:, second], gram[first, second]) + np.log(PAIR * both / both.sum()),
        ]
    )
    pairs = zip(names[first].tolist(), names[second].tolist(), strict=True)
    labels: list[Names] = [(), *((name,) for name in names.tolist()), *((min(pair), max(pair)) for pair in pairs)]
    explanations = sorted(set(labels))
    place = {label: k for k, label in enumerate(explanations)}
    probability = np.exp(evidence - evidence.max(axis=1, keepdims=True))
    table = np.zeros((len(explanations), len(scores)))
    np.add.at(table, [place[label] for label in labels], probability.T)
    table /= table.sum(axis=0)
    order = np.argsort(-table[:, 0])
    enough = int(np.searchsorted(np.cumsum(table[order, 0]), _SET)) + 1
    return Oracle(
        posterior={"+".join(explanations[k]): float(table[k, 0]) for k in order if table[k, 0] > 1e-4},
        right=float(np.mean(table[:, 1:].argmax(axis=0) == place[truth])),
        answer_set=tuple(explanations[k] for k in order[:enough]),
    )


def _let_pass(amplitude: FloatArray) -> FloatArray:
    """The nearest amplitude that is."""
    return np.asarray(np.copysign(np.clip(np.abs(amplitude), LEAST_OF_PAIR, MOST), amplitude))


def _log_prior(amplitude: FloatArray) -> FloatArray:
    return np.asarray(-np.log(2.0 * np.log(MOST / LEAST_OF_PAIR) * np.abs(amplitude)))


def _one(score: FloatArray) -> FloatArray:
    a = _let_pass(score)
    return np.asarray(a * score - 0.5 * a**2 + _log_prior(a) + 0.5 * np.log(2.0 * np.pi))


def _two(x: FloatArray, y: FloatArray, cosine: FloatArray) -> FloatArray:
    """Of scores x and y; the better of both ways to bring two amplitudes into their range one after the other."""
    square = np.maximum(1.0 - cosine**2, 1e-9)
    ways = []
    for one, other in ((x, y), (y, x)):
        a = _let_pass((one - cosine * other) / square)
        b = _let_pass(other - cosine * a)
        ways.append(a * one + b * other - 0.5 * (a**2 + b**2) - cosine * a * b + _log_prior(a) + _log_prior(b))
    width = np.minimum(-0.5 * np.log(square), np.log(MOST))  # amplitudes of signals that are nearly one end, too
    return np.asarray(np.maximum(*ways) + np.log(2.0 * np.pi) + width)
