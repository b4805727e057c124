"""Generalised least squares: the residual weighed by the covariance of its noise, re-evaluated as the law moves.

Minimises r^T Sigma(theta)^-1 r, Sigma = Sigma_y + sigma_x^2 D D^T, D = d stress / d measured strain, without the
determinant of Sigma: structured errors in variables, to first order in the strain's errors. The smallest errors of the
strain that reconcile it with the law are delta = sigma_x^2 D^T Sigma^-1 r.
"""

from __future__ import annotations

from copy import copy
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.identify.autocorrelation import fitted_noise
from probation.identify.bias import low_frequency
from probation.identify.covariance import Covariance, covariance
from probation.identify.noise_model import NoiseModel
from probation.identify.search import first_guess
from probation.identify.strain_noise import (
    CARRIED_NOISE,
    carried_at_end,
    left_over,
    resampled,
    share_of_error,
)
from probation.inference.strain_noise import LARGEST, StrainNoise
from probation.smoothing.excitation import excite
from probation.smoothing.segments import CLEAN

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.identify.problem import Problem, RecordProblem
    from probation.law.modal import Law
    from probation.smoothing.methods import Method as ExcitationMethod

Weighting = Literal["auto", "plain", "strain-noise", "strain-noise-frozen"]
WEIGHTINGS: tuple[Weighting, ...] = ("auto", "plain", "strain-noise", "strain-noise-frozen")

MOST_STEPS = 40
SMALL_STEP, ROUGH_STEP = 1e-3, 0.05
"""Steps [standard errors] at which a search ends, and one that another follows."""

LONGEST_STEP = 0.7
"""Largest change of the logarithm of a parameter in one step."""


@dataclass(frozen=True, eq=False)
class Weighted:
    """What a fit does with its noise.

    Attributes
    ----------
    law : Law
        With the best parameters.
    strain : tuple of StrainNoise or None
        Per record, the strain noise that weighs its residual.
    frozen : bool
        Whether Sigma stays what it was at the least-squares estimate.
    resampled : ndarray, shape (free, free), or None
        Covariance by the strain noise of records too long for a matrix, on top.
    """

    law: Law
    strain: tuple[StrainNoise | None, ...]
    frozen: bool = False
    resampled: FloatArray | None = None

    @property
    def carries_strain_noise(self) -> bool:
        """Whether the residual of any record is weighed for it."""
        return any(each is not None for each in self.strain)


def plainly(problem: Problem, law: Law) -> Weighted:
    """White noise, none of the strain: ordinary least squares, as it was."""
    return Weighted(law, (None,) * len(problem.records))


def weigh(
    problem: Problem,
    law: Law,
    weighting: Weighting,
    limits: Mapping[str, tuple[float, float]],
    excitation: ExcitationMethod,
) -> Weighted:
    """Find the noise of every record at the least-squares law, and the law that is best with it.

    Leaves the noise models in `problem`.

    Parameters
    ----------
    problem : Problem
        With white noise.
    law : Law
        The least-squares one.
    weighting : {"auto", "strain-noise", "strain-noise-frozen"}
        "auto" takes the strain noise where it is more than `CARRIED_NOISE` of a parameter's error.
    limits : mapping of str to (float, float)
        Of the parameters.
    excitation : str
        How the strain was smoothed.
    """
    frozen = weighting == "strain-noise-frozen"
    smooth, there = (problem, law) if frozen else _smoothly_driven(problem, law, limits)
    strain, added = _strain_noises(problem, smooth, there, weighting, excitation)
    weighted = Weighted(law, tuple(strain), frozen, added)
    if weighted.carries_strain_noise:
        # First with the noise as it is known: the least-squares residual may be far from what is left in the end.
        for index, noise in enumerate(strain):
            if noise is not None:
                problem.noises[index] = problem.noises[index].with_carried(noise.carried(law))
        if not frozen and _cost(problem, there, weighted) < _cost(problem, law, weighted):
            law = there
        law = minimise(problem, law, weighted, limits, tolerance=SMALL_STEP if frozen else ROUGH_STEP)
        if frozen:
            return replace(weighted, law=law)
    weighted = replace(weighted, law=law, strain=_find_noises(problem, law, strain))
    if not weighted.carries_strain_noise and not any(noise.correlation for noise in problem.noises):
        problem.noises = list(problem.white)
        return weighted
    return replace(weighted, law=minimise(problem, law, weighted, limits))


def minimise(
    problem: Problem,
    law: Law,
    weighted: Weighted,
    limits: Mapping[str, tuple[float, float]],
    fixed: int | None = None,
    tolerance: float = SMALL_STEP,
) -> Law:
    """The law of least cost, by damped Gauss-Newton from a law that is close.

    Parameters
    ----------
    problem : Problem
        Its noise models are left at those of the result, unless frozen.
    law : Law
    weighted : Weighted
    limits : mapping of str to (float, float)
    fixed : int, optional
        A parameter that does not move, by its number in `law.parameters`.
    tolerance : float
        Step [standard errors] at which the search ends.
    """
    wanted = [int(index) for index in problem.free if index != fixed]
    if not wanted:
        return law
    ends = np.array([limits[law.parameter_names[i]] for i in wanted])
    residual, jacobian = residual_and_jacobian(problem, law, weighted)
    damping = 0.0
    for _ in range(MOST_STEPS):
        values = law.parameters[wanted]
        size = np.where(values != 0.0, np.abs(values), 1.0)
        scaled = jacobian[:, wanted] * size
        normal, gradient = scaled.T @ scaled, scaled.T @ residual
        diagonal = np.diag(np.maximum(np.diag(normal), 1e-300))
        step = -np.linalg.lstsq(normal + damping * diagonal, gradient, rcond=1e-15)[0]
        step *= LONGEST_STEP / np.maximum(np.max(np.abs(step)), LONGEST_STEP)
        found = law.parameters
        found[wanted] = np.clip(values + step * size, np.maximum(ends[:, 0], 1e-3 * size), ends[:, 1])
        freedom = max(len(residual) - len(wanted), 1)
        scatter = float(residual @ residual) / freedom + 1e-300
        length = float(np.sqrt(np.maximum(step @ normal @ step, 0.0) / scatter))
        if length < tolerance and damping < 1.0:
            break
        there = law.with_parameters(found)
        new_residual, new_jacobian = residual_and_jacobian(problem, there, weighted)
        if new_residual @ new_residual < residual @ residual:
            law, residual, jacobian, damping = there, new_residual, new_jacobian, 0.1 * damping
        elif damping > 1e6:
            break
        else:
            damping = max(10.0 * damping, 1e-3)
    reevaluate(problem, law, weighted)
    return law


def reevaluate(problem: Problem, law: Law, weighted: Weighted) -> None:
    """Sigma at this law, unless frozen."""
    if weighted.frozen:
        return
    for index, strain in enumerate(weighted.strain):
        if strain is not None:
            problem.noises[index] = problem.noises[index].with_carried(strain.carried(law))


def residual_and_jacobian(problem: Problem, law: Law, weighted: Weighted) -> tuple[FloatArray, FloatArray]:
    """Whitened residual and the sensitivities that make its exact gradient, shapes (n_samples,), (n_samples, 3).

    With J - (d D / d theta) delta for J, Gauss-Newton descends along the gradient of r^T Sigma(theta)^-1 r: it is the
    sensitivity at the strain that the errors delta correct.
    """
    reevaluate(problem, law, weighted)
    residuals, jacobians = [], []
    for each, noise, strain in zip(problem.records, problem.noises, weighted.strain, strict=True):
        stress, sensitivity = each.sensitivity(law)
        residual = stress - each.record.true_stress
        if strain is not None and noise.carried is not None and not weighted.frozen:
            errors = noise.carried.T @ noise.solve(residual)
            sensitivity = sensitivity.copy()
            sensitivity[:, problem.free] -= strain.slopes(law, errors, problem.free.tolist())
        residuals.append(residual)
        jacobians.append(sensitivity)
    return problem.whitened(residuals), problem.whitened(jacobians)


def known_of(problem: Problem, law: Law, weighted: Weighted) -> tuple[Covariance, FloatArray]:
    """Covariance of the parameters, and the Jacobian that it came from, shape (n_samples, 3)."""
    residual, jacobian = residual_and_jacobian(problem, law, weighted)
    known = covariance(jacobian[:, problem.free], residual, problem.lengths, law.parameters[problem.free])
    if weighted.resampled is not None:
        known = known.with_added(weighted.resampled, law.parameters[problem.free])
    return known, jacobian


def _cost(problem: Problem, law: Law, weighted: Weighted) -> float:
    reevaluate(problem, law, weighted)
    residual = problem.residual(law)
    return float(residual @ residual)


def _smoothly_driven(problem: Problem, law: Law, limits: Mapping[str, tuple[float, float]]) -> tuple[Problem, Law]:
    """The problem with every noisy strain smoothed, and its least-squares law: where noise has not biased the estimate.

    The same problem and law where no record drives the law with its bare samples.
    """
    records = [
        each.driven_by(excite(each.record, "spline")).reference()
        if len(each.record) <= LARGEST and each.excitation.strain_noise >= CLEAN and _is_bare(each)
        else each
        for each in problem.records
    ]
    if all(new is old for new, old in zip(records, problem.records, strict=True)):
        return problem, law
    smooth = copy(problem)
    smooth.records = tuple(records)
    return smooth, first_guess(smooth, limits)


def _is_bare(problem: RecordProblem) -> bool:
    return problem.excitation.strain_rate is None and problem.excitation.strain_operator() is None


def _strain_noises(
    problem: Problem, smooth: Problem, law: Law, weighting: Weighting, excitation: ExcitationMethod
) -> tuple[list[StrainNoise | None], FloatArray | None]:
    """Which records' strain noise matters at `law`, the best one of `smooth`; the covariance by that of long ones."""
    jacobian = smooth.residual_and_jacobian(law)[1][:, problem.free]
    gains = _gains(problem, jacobian)
    error = _error_without(smooth, law, jacobian, gains)
    found: list[StrainNoise | None] = []
    added: FloatArray | None = None
    for each, gain in zip(problem.records, gains, strict=True):
        if len(each.record) > LARGEST:
            found.append(None)
            if carried_at_end(each, law) > 0.3 * CARRIED_NOISE * left_over(each, law):
                moved = resampled(each, law, gain, excitation)
                added = moved if added is None else added + moved
            continue
        noise: StrainNoise | None = None
        if each.excitation.strain_noise >= CLEAN:
            noise = StrainNoise.of(each.excitation, each.scheme, each.substeps)
        if noise is not None and weighting == "auto":
            share = share_of_error(law, noise, gain, error)
            noise = noise if float(np.max(share)) > CARRIED_NOISE else None
        found.append(noise)
    return found, added


def _error_without(problem: Problem, law: Law, jacobian: FloatArray, gains: Sequence[FloatArray]) -> FloatArray:
    """Standard errors by the stress noise and by the bias of the law, shape (free,): without any strain noise.

    That of the bias comes from the low-frequency part of the residual alone, since the rest may be strain noise.
    """
    noise = sum(each.noise**2 * np.sum(gain**2, axis=1) for each, gain in zip(problem.records, gains, strict=True))
    low = problem.whitened(low_frequency(each.stress(law) - each.record.true_stress) for each in problem.records)
    bias = covariance(jacobian, low, problem.lengths, law.parameters[problem.free])
    return np.asarray(np.sqrt(noise + np.diag(bias.matrix)), dtype=np.float64)


def _gains(problem: Problem, jacobian: FloatArray) -> list[FloatArray]:
    """Change of the least-squares parameters by the stress of each record, (free, n_times) [1/MPa]."""
    size = np.linalg.norm(jacobian, axis=0)
    size[size == 0.0] = 1.0
    inverse = np.linalg.pinv(jacobian / size, rcond=1e-12) / size[:, None]
    parts = np.split(inverse, np.cumsum(problem.lengths)[:-1], axis=1)
    return [part / noise.scale for part, noise in zip(parts, problem.noises, strict=True)]


def _find_noises(problem: Problem, law: Law, strain: Sequence[StrainNoise | None]) -> tuple[StrainNoise | None, ...]:
    """Set every record's noise model from its residual at `law`; the strain noises, scaled with them."""
    found: list[StrainNoise | None] = []
    for index, (each, noise) in enumerate(zip(problem.records, strain, strict=True)):
        stress, sensitivity = each.sensitivity(law)
        problem.noises[index], factor = fitted_noise(
            NoiseModel.white(each.noise, each.record.time).with_carried(None if noise is None else noise.carried(law)),
            stress - each.record.true_stress,
            sensitivity[:, problem.free],
            differenced=each.record.noise.stress_MPa is None,
        )
        found.append(None if noise is None else replace(noise, deviation=noise.deviation * factor))
    return tuple(found)
