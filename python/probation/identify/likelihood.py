"""How probable the records are under the law that was found, for comparing laws on the same records."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.noise.outliers import without_outliers

if TYPE_CHECKING:
    from probation.inference.problem import Problem
    from probation.law.modal import Law


def log_likelihood(problem: Problem, law: Law) -> tuple[float, int]:
    r"""Logarithm of the Gaussian likelihood, and how many parameters of the noise went into it.

    .. math:: \ln L = -\tfrac12 \sum_i \left[n_i \ln 2\pi + n_i + \ln|\hat f_i^2 \Sigma_i|\right], \quad
              \hat f_i^2 = r_i^T \Sigma_i^{-1} r_i / n_i

    The size of each record's noise is taken at its most probable value; its shape (correlation, strain noise) is that
    of the fit.

    Parameters
    ----------
    problem : Problem
        With the noise of the fit.
    law : Law
        The best one.
    """
    total, estimated = 0.0, 0
    for each, noise in zip(problem.records, problem.noises_at(law), strict=True):
        whitened = noise.whiten(without_outliers(each.residual(law), noise.outliers))
        count = len(whitened)
        size = max(float(whitened @ whitened) / count, 1e-300)
        total -= 0.5 * (count * (np.log(2.0 * np.pi) + 1.0 + np.log(size)) + noise.log_determinant)
        estimated += 1 + (noise.arma.phi != 0.0) + (noise.arma.theta != 0.0)
    return float(total), estimated
