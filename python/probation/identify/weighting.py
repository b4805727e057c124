"""Generalised least squares: the residual weighed by the covariance of its noise, re-evaluated as the law moves.

Minimises r^T Sigma(theta)^-1 r, Sigma = Sigma_y + A A^T, A = sigma_eps d stress / d measured strain, without the
determinant of Sigma: structured errors in variables, to first order in the strain's errors. The smallest errors of the
strain that reconcile it with the law are delta = A^T Sigma^-1 r, in standard deviations.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.identify.bias import low_frequency
from probation.identify.covariance import Covariance, covariance, noise_widening
from probation.identify.errors_by_strain_noise import left_over, propagated_at_end, resampled, share_of_error
from probation.identify.search import by_least_squares, first_guess
from probation.inference.residual_noise import with_residual_noise
from probation.inference.strain_noise import StrainNoise
from probation.settings.certificate import CERTIFICATE
from probation.settings.identification import IDENTIFICATION
from probation.settings.noise import NOISE
from probation.settings.smoothing import SMOOTHING
from probation.smoothing.excitation import excite

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.problem import Problem
    from probation.law.modal import Law
    from probation.smoothing.methods import Method as ExcitationMethod

Weighting = Literal["auto", "plain", "strain-noise", "strain-noise-frozen"]
WEIGHTINGS: tuple[Weighting, ...] = ("auto", "plain", "strain-noise", "strain-noise-frozen")

SMALL_STEP, ROUGH_STEP = 1e-3, 0.05
"""Steps [standard errors] at which a search ends, and one that another follows."""


@dataclass(frozen=True, eq=False)
class Weighted:
    """Parameters and the noise that they were found with.

    Attributes
    ----------
    problem : Problem
        With the noise that weighs its residuals.
    parameters : ndarray, shape (free,)
        The best ones.
    resampled : ndarray, shape (free, free), or None
        Covariance by the strain noise of records too long for a matrix, on top.
    """

    problem: Problem
    parameters: FloatArray
    resampled: FloatArray | None = None

    @property
    def law(self) -> Law:
        """The best one."""
        return self.problem.law_at(self.parameters)


def weigh(
    problem: Problem,
    plain: FloatArray,
    weighting: Weighting,
    limits: Mapping[str, tuple[float, float]],
    excitation: ExcitationMethod,
) -> Weighted:
    """Find the noise of every record at the least-squares law, and the parameters that are best with it.

    Parameters
    ----------
    problem : Problem
        With white noise.
    plain : ndarray, shape (free,)
        The least-squares parameters.
    weighting : {"auto", "strain-noise", "strain-noise-frozen"}
        "auto" takes the strain noise where it is more than `CERTIFICATE.strain_noise_matters` of a parameter's error.
    limits : mapping of str to (float, float)
        Of the parameters.
    excitation : str
        How the strain was smoothed.
    """
    frozen = weighting == "strain-noise-frozen"
    parameters = plain
    smooth, there = (problem, parameters) if frozen else _smoothly_driven(problem, parameters, limits)
    strain, added = _strain_noises(problem, smooth, there, weighting, excitation)
    if any(noise is not None for noise in strain):
        # First with the noise as it is known: the least-squares residual may be far from what is left in the end.
        known = problem.with_noises(problem.whitener.noises, strain)
        if frozen:
            known = known.frozen_at(parameters)
            return Weighted(known, by_least_squares(known, parameters, limits, tolerance=SMALL_STEP), added)
        if _cost(known, there) < _cost(known, parameters):
            parameters = there
        parameters = by_least_squares(known, parameters, limits, tolerance=ROUGH_STEP)
    weighed = with_residual_noise(problem, parameters, strain)
    if not weighed.carries_strain_noise and all(noise.plain for noise in weighed.whitener.noises):
        return Weighted(problem, parameters, added)
    return Weighted(weighed, by_least_squares(weighed, parameters, limits, tolerance=SMALL_STEP), added)


def known_of(weighted: Weighted) -> tuple[Covariance, FloatArray]:
    """Covariance of the parameters, and the Jacobian that it came from, shape (n_samples, free)."""
    problem, values = weighted.problem, weighted.parameters
    residual, jacobian = problem.residual_and_jacobian(values)
    # What is unknown of a smoothed strain need not be wrong: a small residual makes no other error smaller.
    smoothed = problem.carries_strain_noise and any(view.excitation.errors is not None for view in problem.views)
    known = covariance(jacobian, residual, problem.lengths, values, least_scatter=float(smoothed))
    known = known.widened(noise_widening(problem.noises_at(values)))
    if weighted.resampled is not None:
        known = known.with_added(weighted.resampled, values)
    return known, jacobian


def _cost(problem: Problem, parameters: FloatArray) -> float:
    residual = problem.residual(parameters)
    return float(residual @ residual)


def _smoothly_driven(
    problem: Problem, parameters: FloatArray, limits: Mapping[str, tuple[float, float]]
) -> tuple[Problem, FloatArray]:
    """The problem with every noisy strain smoothed, and its best parameters: where noise has not biased the estimate.

    The same problem and parameters where no record drives the law with its bare samples.
    """
    views = [
        view.smoothed_as(excite(view.record, "spline")).with_scheme("sa3")
        if len(view.record) <= NOISE.most_with_strain_noise
        and view.excitation.strain_noise >= SMOOTHING.clean
        and _is_bare(view)
        else view
        for view in problem.views
    ]
    if all(new is old for new, old in zip(views, problem.views, strict=True)):
        return problem, parameters
    smooth = problem.with_views(views)
    return smooth, first_guess(smooth, limits)


def _is_bare(view: RecordView) -> bool:
    return view.excitation.strain_rate is None and view.excitation.strain_operator() is None


def _strain_noises(
    problem: Problem, smooth: Problem, parameters: FloatArray, weighting: Weighting, excitation: ExcitationMethod
) -> tuple[list[StrainNoise | None], FloatArray | None]:
    """Which records' strain noise matters at the best parameters of `smooth`; the covariance by that of long ones."""
    jacobian = smooth.residual_and_jacobian(parameters)[1]
    gains = _gains(problem, jacobian)
    error = _error_without(smooth, parameters, jacobian, gains)
    law = problem.law_at(parameters)
    noises: list[StrainNoise | None] = []
    added: FloatArray | None = None
    for view, gain in zip(problem.views, gains, strict=True):
        if len(view.record) > NOISE.most_with_strain_noise:
            noises.append(None)
            enough = IDENTIFICATION.early_part_of_strain_noise * CERTIFICATE.strain_noise_matters
            if propagated_at_end(view, law) > enough * left_over(view, law):
                moved = resampled(view, law, gain, excitation)
                added = moved if added is None else added + moved
            continue
        noise: StrainNoise | None = None
        if view.excitation.strain_noise >= SMOOTHING.clean:
            noise = StrainNoise.of(view.excitation, view.scheme, view.stride)
        if noise is not None and weighting == "auto":
            share = share_of_error(law, noise, gain, error)
            noise = noise if float(np.max(share)) > CERTIFICATE.strain_noise_matters else None
        noises.append(noise)
    return noises, added


def _error_without(
    problem: Problem, parameters: FloatArray, jacobian: FloatArray, gains: Sequence[FloatArray]
) -> FloatArray:
    """Standard errors by the stress noise and by the bias of the law, shape (free,): without any strain noise.

    That of the bias comes from the low-frequency part of the residual alone, since the rest may be strain noise.
    """
    noise = sum(view.stress_noise**2 * np.sum(gain**2, axis=1) for view, gain in zip(problem.views, gains, strict=True))
    residual = problem.model.residual(parameters)
    low = np.concatenate([low_frequency(residual[rows]) for _, rows in problem.model.parts])
    bias = covariance(jacobian, problem.whitener_at(parameters).residual(low), problem.lengths, parameters)
    return np.asarray(np.sqrt(noise + np.diag(bias.matrix)), dtype=np.float64)


def _gains(problem: Problem, jacobian: FloatArray) -> list[FloatArray]:
    """Change of the least-squares parameters by the stress of each record, (free, n_times) [1/MPa]."""
    size = np.linalg.norm(jacobian, axis=0)
    size[size == 0.0] = 1.0
    inverse = np.linalg.pinv(jacobian / size, rcond=1e-12) / size[:, None]
    parts = np.split(inverse, np.cumsum(problem.lengths)[:-1], axis=1)
    return [part / noise.sigma for part, noise in zip(parts, problem.whitener.noises, strict=True)]
