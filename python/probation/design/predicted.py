"""What every explanation predicts of a test that is not done yet, and how often that test would find the right one.

Under explanation k, whose parameters the records there are leave uncertain with covariance C_k, the whitened result is
normal: y ~ N(f_k, I + J_k C_k J_k^T). That is the rival refitted to old and new records together, to first order, and
the old records holding it back; the choice between explanations by these densities is Box & Hill's (1967).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import solve_triangular
from scipy.special import entr

from probation.design.planned_record import planned_noise, planned_view
from probation.inference.model import CampaignModel
from probation.noise.whitener import Whitener
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.design.planned_tests import ProposedTest
    from probation.effects.cause import Cause
    from probation.effects.record_view import RecordView
    from probation.noise.model import NoiseModel


PER_GAUGE_LENGTH = ("machine_compliance", "strain_offset", "grip_slip")
"""Effects that add a displacement, so that their strain falls with the gauge length."""

_LOOSE = 1e-12
"""Information on a direction of the parameters below which it is taken as this."""


@dataclass(frozen=True, eq=False)
class RivalExplanation:
    """One explanation of the records there are.

    Attributes
    ----------
    model : CampaignModel
        With its causes.
    parameters : ndarray, shape (n_parameters,)
        At their optimum.
    effects : tuple of str
    root : ndarray, shape (n_parameters, n_parameters)
        R with R R^T = C, the covariance that the records and the priors leave.
    """

    model: CampaignModel
    parameters: FloatArray
    probability: float
    effects: tuple[str, ...]
    root: FloatArray

    @classmethod
    def of(
        cls,
        model: CampaignModel,
        parameters: FloatArray,
        probability: float,
        effects: Sequence[str],
        noises: Sequence[NoiseModel],
    ) -> RivalExplanation:
        """With what the model's own records, one noise each, tell of its parameters."""
        jacobian = model.jacobian(parameters)
        white = Whitener(tuple(noises)).columns(jacobian)
        known = np.zeros(len(parameters))
        known[model.base_count :] = [
            _prior_precision(parameter.scale, parameter.log, value)
            for parameter, value in zip(model.effect_parameters, parameters[model.base_count :], strict=True)
        ]
        information = white.T @ white + np.diag(known)
        size = np.sqrt(np.diag(information))
        size[size == 0.0] = 1.0
        values, vectors = np.linalg.eigh(information / np.outer(size, size))
        root = vectors / np.sqrt(np.maximum(values, _LOOSE * values[-1])) / size[:, None]
        return cls(model, parameters, probability, tuple(effects), root)


@dataclass(frozen=True, eq=False)
class RivalPrediction:
    """One way in which a planned test may come out.

    Attributes
    ----------
    owner : int
        Whose: an index into the explanations.
    weight : float
        Of its explanation's ways: they sum to 1.
    mean : ndarray, shape (n_samples,)
        Whitened.
    spread : ndarray, shape (n_samples, n_parameters)
        A with A A^T the covariance that uncertain parameters give, whitened.
    """

    owner: int
    weight: float
    mean: FloatArray
    spread: FloatArray

    def through(self, noise: float) -> RivalPrediction:
        """The same seen through `noise` times the noise."""
        return replace(self, mean=self.mean / noise, spread=self.spread / noise)


def predictions(
    test: ProposedTest,
    model: CampaignModel,
    base: FloatArray,
    explanations: Sequence[RivalExplanation],
    noises: Sequence[NoiseModel],
) -> list[RivalPrediction]:
    """What every explanation predicts of a test.

    A cause that touches all records touches the new one too. A fault of single records may or may not be there again
    (`DESIGN.fault_repeats`), unless its form can sit nowhere but in one record: a slip does not repeat itself. One with
    a size each in several records comes back as it was in the last.

    Parameters
    ----------
    model : CampaignModel
        The law without causes, on the records there are.
    base : ndarray
        Its parameters, for the force that the frame feels.
    explanations : sequence of RivalExplanation
    noises : sequence of NoiseModel
        Of the records there are.
    """
    view = _view(test, model)
    noise = planned_noise(view, noises, model.views)
    view = view.as_predicted(model.law.stress(view, base))
    predicted = []
    for owner, explanation in enumerate(explanations):
        confined = {cause.effect.name: cause for cause in explanation.model.causes if _may_come_back(cause)}
        ways = (
            [((), 1.0)]
            if not confined
            else [((), 1.0 - DESIGN.fault_repeats), (tuple(confined.values()), DESIGN.fault_repeats)]
        )
        for back, weight in ways:
            stress, slopes = _on(view, explanation, back, test)
            predicted.append(
                RivalPrediction(owner, weight, noise.whiten(stress), noise.whiten(slopes @ explanation.root))
            )
    return predicted


def _view(test: ProposedTest, model: CampaignModel) -> RecordView:
    """A repeat is driven as its record was, smoothing and all."""
    for view in model.views:
        if view.id == test.repeats:
            return replace(view, id=test.name, index=view.count)
    return planned_view(test.name, test.time, test.true_strain, test.jumps, model.views)


def _may_come_back(cause: Cause) -> bool:
    return cause.records is not None and "all" in cause.effect.placements(cause.form)


def _on(
    view: RecordView, explanation: RivalExplanation, back: Sequence[Cause], test: ProposedTest
) -> tuple[FloatArray, FloatArray]:
    """Stress (n_samples,) [MPa] and slopes (n_samples, n_parameters) of an explanation on a planned record."""
    base, active = explanation.model.split(explanation.parameters)
    slopes = np.zeros((len(view.data), len(explanation.parameters)))
    causes, values, columns, factors = [], list(base), list(range(len(base))), [1.0] * len(base)
    first = len(base)
    for cause, own in active:
        if cause.records is None or cause in back:
            factor = 1.0 / test.gauge_length if cause.effect.name in PER_GAUGE_LENGTH else 1.0
            causes.append(type(cause)(cause.effect, cause.form, None if cause.records is None else (view.id,)))
            values += [factor * own[0], *own[1:]]
            columns += range(first, first + len(own))
            factors += [factor, *(1.0 for _ in own[1:])]
        first += len(own)
    model = CampaignModel(explanation.model.law, (view,), causes)
    residual, jacobian = model.residual_and_jacobian(np.array(values))
    slopes[:, columns] = jacobian * factors
    return residual + model.data, slopes


@dataclass(frozen=True, eq=False)
class Weighing:
    """How far evidence counts: that of a test together with that of the records there are.

    Where no form is quite nature's, an explanation that is far behind may be right all the same, and one more record
    that puts it further behind tells little. A repeat of a record that two explanations describe alike tells nothing.

    Attributes
    ----------
    log_evidence : ndarray, shape (n_explanations,)
        By the records there are.
    fall : callable
        ``fall(distance)``: log odds of what is so far in log evidence behind the best one.
    """

    log_evidence: FloatArray
    fall: Callable[[FloatArray], FloatArray]

    @classmethod
    def in_full(cls, count: int) -> Weighing:
        """Of so many explanations, all of whose evidence counts: forms are nature's."""
        return cls(np.zeros(count), np.negative)

    def gained(self, log_density: FloatArray, owners: NDArray[np.intp]) -> FloatArray:
        """Log odds that results give the ways, shape (n_draws, n_ways), of their log densities; `owners` of the ways.

        An explanation is as probable as its own evidence says, whichever way it comes about.
        """
        before = self.log_evidence[owners]
        after = before + log_density
        distance = after.max(axis=1, keepdims=True) - after
        return np.asarray(self.fall(distance) - self.fall(before.max() - before))


@dataclass(frozen=True, eq=False)
class Outcome:
    """How often a test would find the right one.

    Attributes
    ----------
    probability : float
        That the most probable explanation after the test is the right one.
    information : float
        Expected gain on which explanation it is [bit].
    pairwise : ndarray, shape (n_groups, n_groups)
        That the right one (row) describes the test better than another (column).
    """

    probability: float
    information: float
    pairwise: FloatArray


def outcome(
    ways: Sequence[RivalPrediction],
    prior: FloatArray,
    group: Sequence[int],
    *,
    draws: int,
    seed: int,
    weighing: Weighing | None = None,
) -> Outcome:
    """Simulate the test under every explanation and weigh all by what comes out.

    Parameters
    ----------
    ways : sequence of RivalPrediction
    prior : ndarray, shape (n_explanations,)
        Probabilities before the test, summing to 1.
    group : sequence of int
        Which answer each explanation is; several may be the same.
    draws : int
        Of each way.
    weighing : Weighing, optional
        All evidence counts, if left out.
    """
    weighing = Weighing.in_full(len(prior)) if weighing is None else weighing
    owners = np.array([way.owner for way in ways])
    before = prior[owners] * np.array([way.weight for way in ways])
    groups = np.asarray(group)[owners]
    member = np.eye(max(group) + 1)[groups]
    total = before @ member
    means, roots = _reduced(ways)
    inverses = [solve_triangular(root, np.eye(len(root)), lower=True) for root in roots]
    noise = np.random.default_rng(seed).standard_normal((draws, means.shape[1]))
    probability, information = 0.0, float(entr(total).sum())
    wins = np.zeros((len(total), len(total)))
    for share, own, mean, root in zip(before, groups, means, roots, strict=True):
        results = mean + noise @ root.T
        logs = [_log_density(results, m, inverse) for m, inverse in zip(means, inverses, strict=True)]
        densities = weighing.gained(np.stack(logs, axis=1), owners)
        joint = (np.exp(densities - densities.max(axis=1, keepdims=True)) * before) @ member
        posterior = joint / joint.sum(axis=1, keepdims=True)
        probability += share * float(np.mean(posterior.max(axis=1)))
        information -= share * float(np.mean(entr(posterior).sum(axis=1)))
        alone = joint / total
        ahead = np.mean((alone[:, [own]] > alone) + 0.5 * (alone[:, [own]] == alone), axis=0)
        wins[own] += share / total[own] * ahead
    np.fill_diagonal(wins, 1.0)
    return Outcome(min(probability, 1.0), max(information, 0.0) / np.log(2.0), wins)


def _reduced(ways: Sequence[RivalPrediction]) -> tuple[FloatArray, list[FloatArray]]:
    """Means (n_ways, m) and Cholesky factors (m, m) in the few coordinates in which the predictions differ."""
    centre = np.mean([way.mean for way in ways], axis=0)
    columns = np.column_stack([*(way.mean - centre for way in ways), *(way.spread for way in ways)])
    left, size, _ = np.linalg.svd(columns[:, np.any(columns != 0.0, axis=0)], full_matrices=False)
    seen = size > DESIGN.seen_in_noise
    frame = left[:, seen] if seen.any() else np.zeros((len(columns), 1))
    means: FloatArray = np.array([frame.T @ (way.mean - centre) for way in ways])
    roots: list[FloatArray] = []
    for way in ways:
        inside = frame.T @ way.spread
        roots.append(np.asarray(np.linalg.cholesky(np.eye(len(inside)) + inside @ inside.T), dtype=np.float64))
    return means, roots


def _log_density(results: FloatArray, mean: FloatArray, inverse: FloatArray) -> FloatArray:
    """Of every result (n_draws, m), but for a constant; `inverse` is that of the covariance's Cholesky factor."""
    whitened = (results - mean) @ inverse.T
    return np.asarray(-0.5 * np.sum(whitened**2, axis=1) + np.sum(np.log(np.diag(inverse))), dtype=np.float64)


def _prior_precision(scale: float, log: bool, value: float) -> float:
    """1 / variance of an effect's parameter by its prior alone, along the parameter itself."""
    deviation = scale * abs(value) if log else scale
    return 1.0 / deviation**2 if np.isfinite(deviation) and deviation > 0.0 else 0.0
