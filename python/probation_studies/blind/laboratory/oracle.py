"""What somebody could tell who knows every form, every prior and the noise: the best that a solver can be asked for.

Residual z = sum of signals + white noise, in the space without the base law's tangent. An explanation is a set of
signals S of norm t with standard normal amplitudes, t being one of the detectabilities that the laboratory aims at, as
far as plausible amplitudes reach; its evidence is closed: -ln det(I + A) / 2 + b^T (I + A)^-1 b / 2 with A = S^T S,
b = S^T z, and the mean over t.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations, product
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from scipy.linalg import cho_factor, cho_solve

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.bank import Signal
    from probation_studies.blind.laboratory.material import FloatArray

Names: TypeAlias = "tuple[str, ...]"

TARGETS = (3.0, 5.0, 8.0, 15.0, 40.0, 100.0)
"""Detectabilities, sqrt(lambda), that are aimed at."""

_PAIR_TARGETS = (7.0, 30.0)
_PAIRED = 12
"""Placed causes of which pairs are formed."""
_REPEATS = 200
_PRIOR_OF_NONE, _PRIOR_OF_PAIRS, _PRIOR_OF_UNKNOWN = 0.4, 0.15, 0.15


@dataclass(frozen=True)
class OracleView:
    """What the oracle makes of a campaign.

    Attributes
    ----------
    posterior : dict
        Probability of every explanation (names joined by "+", "" for none) above 1e-4.
    right : float
        Part of repeated noise draws in which its best explanation is the true one.
    answer_set : tuple of Names
        Smallest set of probability 0.9, best first.
    """

    posterior: dict[str, float]
    right: float
    answer_set: tuple[Names, ...]

    @property
    def resolvable(self) -> bool:
        """Whether the truth can be told from the data."""
        return self.right >= 0.95


@dataclass(frozen=True)
class _Member:
    names: Names
    columns: list[int]
    sizes: list[FloatArray]
    log_prior: float


def explanation(signals: Sequence[Signal]) -> Names:
    """Names of an explanation, sorted; what has none in the catalogue is unknown."""
    return tuple(sorted({signal.cause.answer for signal in signals}))


def consult(
    random: Generator, signals: Sequence[Signal], clean: FloatArray, observed: FloatArray, acting: Sequence[Signal]
) -> OracleView:
    """Ask the oracle.

    Parameters
    ----------
    random : Generator
    signals : sequence of Signal
        The bank, the true shapes among it.
    clean, observed : ndarray, shape (n_all,)
        Projected residual without noise, and as observed.
    acting : sequence of Signal
        Those of the bank that are true.
    """
    columns = np.stack([signal.column / signal.norm for signal in signals], axis=1)
    gram = columns.T @ columns
    root = np.linalg.cholesky(gram + 1e-9 * np.eye(len(gram)))
    seen = columns.T @ observed
    expected = (columns.T @ clean)[:, None] + root @ random.standard_normal((len(gram), _REPEATS))
    scores = np.column_stack([seen, expected])
    members = _members(signals, columns.T @ clean, [each.where for each in acting])
    truth = explanation(acting)
    explanations: dict[Names, list[FloatArray]] = {(): [np.full(scores.shape[1], np.log(_PRIOR_OF_NONE))]}
    for member in members:
        evidence = member.log_prior + _log_evidence(gram, scores, member)
        explanations.setdefault(member.names, []).append(evidence)
    names = list(explanations)
    log_weight = np.stack([np.logaddexp.reduce(explanations[name], axis=0) for name in names])
    best = np.argmax(log_weight[:, 1:], axis=0)
    right = float(np.mean([names[k] == truth for k in best]))
    weight = np.exp(log_weight[:, 0] - log_weight[:, 0].max())
    weight /= weight.sum()
    order = np.argsort(-weight)
    enough = int(np.searchsorted(np.cumsum(weight[order]), 0.9)) + 1
    return OracleView(
        posterior={"+".join(names[k]): float(weight[k]) for k in order if weight[k] > 1e-4},
        right=right,
        answer_set=tuple(names[k] for k in order[:enough]),
    )


def _log_evidence(gram: FloatArray, scores: FloatArray, member: _Member) -> FloatArray:
    """Over that of no signal, for every column of scores."""
    some, b = gram[np.ix_(member.columns, member.columns)], scores[member.columns]
    found = []
    for sizes in member.sizes:
        factor = cho_factor(np.eye(len(sizes)) + some * np.outer(sizes, sizes), lower=True)
        scaled = b * sizes[:, None]
        found.append(0.5 * np.sum(scaled * cho_solve(factor, scaled), axis=0) - np.sum(np.log(np.diag(factor[0]))))
    return np.asarray(np.logaddexp.reduce(found, axis=0) - np.log(len(found)))


def _sizes(signals: Sequence[Signal], held: Sequence[int], targets: Sequence[float]) -> list[FloatArray]:
    """For every target, the norms that the signals of one placed cause share it with."""
    reach = np.array([3.0 * signals[k].norm for k in held])
    found = [np.full(len(held), target) for target in targets if target <= 1.2 * reach.max()]
    return [np.minimum(each, reach) / np.sqrt(len(held)) for each in found or [reach]]


def _members(
    signals: Sequence[Signal], expected: FloatArray, acting: Sequence[tuple[str, tuple[int, ...]]]
) -> list[_Member]:
    """Every shape alone, all shapes of a placed cause together, and pairs of the most telling placed causes."""
    placed: dict[tuple[str, tuple[int, ...]], list[int]] = {}
    for k, signal in enumerate(signals):
        placed.setdefault(signal.where, []).append(k)
    known = {where[0] for where, held in placed.items() if not signals[held[0]].cause.outside}
    outside = {where[0] for where, held in placed.items() if signals[held[0]].cause.outside}
    share = np.log(1.0 - _PRIOR_OF_NONE - _PRIOR_OF_PAIRS - _PRIOR_OF_UNKNOWN) - np.log(max(len(known), 1))
    share_outside = np.log(_PRIOR_OF_UNKNOWN) - np.log(max(len(outside), 1))
    members: list[_Member] = []
    per_name = {name: sum(where[0] == name for where in placed) for name in known | outside}
    for where, held in placed.items():
        names = explanation([signals[held[0]]])
        prior = (share_outside if where[0] in outside else share) - np.log(per_name[where[0]])
        for k in held:
            members.append(_Member(names, [k], _sizes(signals, [k], TARGETS), float(prior - np.log(2.0 * len(held)))))
        members.append(_Member(names, held, _sizes(signals, held, TARGETS), float(prior - np.log(2.0))))
    telling = sorted(placed, key=lambda where: -max(abs(expected[k]) for k in placed[where]))[:_PAIRED]
    telling = list(dict.fromkeys([*acting, *telling]))
    telling = [where for where in telling if where[0] in known]
    pairs = [(one, two) for one, two in combinations(telling, 2) if one[0] != two[0]]
    count = len(known) * (len(known) - 1) / 2.0
    for one, two in pairs:
        both = [*placed[one], *placed[two]]
        prior = np.log(_PRIOR_OF_PAIRS / count) - np.log(per_name[one[0]]) - np.log(per_name[two[0]])
        sizes = [
            np.concatenate(each)
            for each in product(
                _sizes(signals, placed[one], _PAIR_TARGETS), _sizes(signals, placed[two], _PAIR_TARGETS)
            )
        ]
        members.append(_Member(explanation([signals[k] for k in both]), both, sizes, float(prior)))
    return members
