"""How probable the records are under a law and its noise: for comparing laws on the same records, and for samplers."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.problem import Problem


def log_likelihood(problem: Problem, parameters: FloatArray) -> float:
    r"""Logarithm of the Gaussian likelihood.

    .. math:: \ln L = -\tfrac12 \sum_i \left[n_i \ln 2\pi + n_i + \ln|\hat f_i^2 \Sigma_i|\right], \quad
              \hat f_i^2 = r_i^T \Sigma_i^{-1} r_i / n_i

    The size of each record's noise is taken at its most probable value; its shape (correlation, strain noise) is that
    of the problem. With the size integrated out, its prior being 1 / size, the same comes but for a constant.

    Parameters
    ----------
    problem : Problem
        Its records have no deviations in common.
    parameters : ndarray, shape (n_parameters,)
    """
    total = 0.0
    whitener = problem.whitener_at(parameters)
    white = whitener.residual(problem.model.residual(parameters))
    for noise, rows in zip(whitener.noises, whitener.slices, strict=True):
        count = rows.stop - rows.start
        size = max(float(white[rows] @ white[rows]) / count, 1e-300)
        total -= 0.5 * (count * (np.log(2.0 * np.pi) + 1.0 + np.log(size)) + noise.log_determinant)
    return float(total)


def noise_parameters(problem: Problem) -> int:
    """How many parameters of the noise go into the likelihood."""
    return sum(1 + (noise.arma.phi != 0.0) + (noise.arma.theta != 0.0) for noise in problem.whitener.noises)
