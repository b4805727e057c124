"""Generalised least squares: the residual weighed by the covariance of its noise, re-evaluated as the law moves.

Minimises r^T Sigma(theta)^-1 r, Sigma = Sigma_y + sigma_x^2 D D^T, D = d stress / d measured strain, without the
determinant of Sigma: structured errors in variables, to first order in the strain's errors. The smallest errors of the
strain that reconcile it with the law are delta = sigma_x^2 D^T Sigma^-1 r.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.identify.bias import low_frequency
from probation.identify.covariance import Covariance, covariance, noise_widening
from probation.identify.search import by_least_squares, first_guess
from probation.identify.strain_noise import carried_at_end, left_over, resampled, share_of_error
from probation.inference.residual_noise import residual_noises
from probation.inference.strain_noise import LARGEST, StrainNoise
from probation.settings.certificate import CERTIFICATE
from probation.smoothing.excitation import excite
from probation.smoothing.segments import CLEAN

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem
    from probation.inference.record_problem import RecordProblem
    from probation.law.modal import Law
    from probation.smoothing.methods import Method as ExcitationMethod

Weighting = Literal["auto", "plain", "strain-noise", "strain-noise-frozen"]
WEIGHTINGS: tuple[Weighting, ...] = ("auto", "plain", "strain-noise", "strain-noise-frozen")

SMALL_STEP, ROUGH_STEP = 1e-3, 0.05
"""Steps [standard errors] at which a search ends, and one that another follows."""


@dataclass(frozen=True, eq=False)
class Weighted:
    """A law and the noise that it was found with.

    Attributes
    ----------
    problem : Problem
        With the noise that weighs its residuals.
    law : Law
        The best one.
    resampled : ndarray, shape (free, free), or None
        Covariance by the strain noise of records too long for a matrix, on top.
    """

    problem: Problem
    law: Law
    resampled: FloatArray | None = None


def weigh(
    problem: Problem,
    law: Law,
    weighting: Weighting,
    limits: Mapping[str, tuple[float, float]],
    excitation: ExcitationMethod,
) -> Weighted:
    """Find the noise of every record at the least-squares law, and the law that is best with it.

    Parameters
    ----------
    problem : Problem
        With white noise.
    law : Law
        The least-squares one.
    weighting : {"auto", "strain-noise", "strain-noise-frozen"}
        "auto" takes the strain noise where it is more than `CERTIFICATE.strain_noise_matters` of a parameter's error.
    limits : mapping of str to (float, float)
        Of the parameters.
    excitation : str
        How the strain was smoothed.
    """
    frozen = weighting == "strain-noise-frozen"
    smooth, there = (problem, law) if frozen else _smoothly_driven(problem, law, limits)
    strain, added = _strain_noises(problem, smooth, there, weighting, excitation)
    if any(each is not None for each in strain):
        # First with the noise as it is known: the least-squares residual may be far from what is left in the end.
        known = problem.with_noises(replace(was, strain=own) for was, own in zip(problem.noises, strain, strict=True))
        if frozen:
            known = known.frozen_at(law)
            return Weighted(known, by_least_squares(known, law, limits, tolerance=SMALL_STEP), added)
        if _cost(known, there) < _cost(known, law):
            law = there
        law = by_least_squares(known, law, limits, tolerance=ROUGH_STEP)
    found = problem.with_noises(residual_noises(problem, law, strain))
    if not found.carries_strain_noise and all(noise.stress.plain for noise in found.noises):
        return Weighted(problem, law, added)
    return Weighted(found, by_least_squares(found, law, limits, tolerance=SMALL_STEP), added)


def known_of(weighted: Weighted) -> tuple[Covariance, FloatArray]:
    """Covariance of the parameters, and the Jacobian that it came from, shape (n_samples, 3)."""
    problem, values = weighted.problem, weighted.law.parameters[weighted.problem.free]
    residual, jacobian = problem.residual_and_jacobian(weighted.law)
    known = covariance(jacobian[:, problem.free], residual, problem.lengths, values)
    known = known.widened(noise_widening(problem.noises_at(weighted.law)))
    if weighted.resampled is not None:
        known = known.with_added(weighted.resampled, values)
    return known, jacobian


def _cost(problem: Problem, law: Law) -> float:
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
    smooth = problem.with_records(records)
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
            if carried_at_end(each, law) > 0.3 * CERTIFICATE.strain_noise_matters * left_over(each, law):
                moved = resampled(each, law, gain, excitation)
                added = moved if added is None else added + moved
            continue
        noise: StrainNoise | None = None
        if each.excitation.strain_noise >= CLEAN:
            noise = StrainNoise.of(each.excitation, each.scheme, each.substeps)
        if noise is not None and weighting == "auto":
            share = share_of_error(law, noise, gain, error)
            noise = noise if float(np.max(share)) > CERTIFICATE.strain_noise_matters else None
        found.append(noise)
    return found, added


def _error_without(problem: Problem, law: Law, jacobian: FloatArray, gains: Sequence[FloatArray]) -> FloatArray:
    """Standard errors by the stress noise and by the bias of the law, shape (free,): without any strain noise.

    That of the bias comes from the low-frequency part of the residual alone, since the rest may be strain noise.
    """
    noise = sum(each.noise**2 * np.sum(gain**2, axis=1) for each, gain in zip(problem.records, gains, strict=True))
    low = problem.whitened((low_frequency(each.residual(law)) for each in problem.records), law)
    bias = covariance(jacobian, low, problem.lengths, law.parameters[problem.free])
    return np.asarray(np.sqrt(noise + np.diag(bias.matrix)), dtype=np.float64)


def _gains(problem: Problem, jacobian: FloatArray) -> list[FloatArray]:
    """Change of the least-squares parameters by the stress of each record, (free, n_times) [1/MPa]."""
    size = np.linalg.norm(jacobian, axis=0)
    size[size == 0.0] = 1.0
    inverse = np.linalg.pinv(jacobian / size, rcond=1e-12) / size[:, None]
    parts = np.split(inverse, np.cumsum(problem.lengths)[:-1], axis=1)
    return [part / noise.stress.sigma for part, noise in zip(parts, problem.noises, strict=True)]
