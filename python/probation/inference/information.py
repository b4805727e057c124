"""What sensitivities say of parameters: the inverse of the Fisher information, errors, correlations."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from probation.inference.parameter import Parameter, status_of

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray

SINGULAR = 1e-12
"""Relative singular value below which a direction of the parameters is taken as not determined at all."""


def inverse_information(jacobian: FloatArray) -> tuple[FloatArray, NDArray[np.bool_], float]:
    """(J^T J)^-1 along the directions that the samples determine, from the singular values of J.

    Parameters
    ----------
    jacobian : ndarray, shape (n_samples, free)
        In white coordinates; its columns scaled by the parameters, so that their sizes can be compared.

    Returns
    -------
    inverse : ndarray, shape (free, free)
    lost : ndarray of bool, shape (free,)
        Parameters that the samples do not determine.
    condition : float
        Number of the Jacobian; inf where it is singular.
    """
    _, singular, basis = np.linalg.svd(jacobian, full_matrices=False)
    determined = singular > SINGULAR * max(singular[0], 1e-300)
    inverse = (basis[determined].T / singular[determined] ** 2) @ basis[determined]
    lost = np.sqrt(np.sum(basis[~determined] ** 2, axis=0)) > 1e-6
    condition = float(singular[0] / singular[-1]) if singular[-1] > 0.0 else np.inf
    return inverse, lost, condition


def correlation(matrix: FloatArray) -> FloatArray:
    """Correlation matrix of a covariance matrix; 0 where a variance is."""
    deviation = np.sqrt(np.diag(matrix))
    with np.errstate(divide="ignore", invalid="ignore"):
        scaled = matrix / np.outer(deviation, deviation)
    scaled[~np.isfinite(scaled)] = 0.0
    np.fill_diagonal(scaled, 1.0)
    return np.asarray(scaled, dtype=np.float64)


def estimated(name: str, value: float, se: float | None, relative_error: float, degrees: int, unit: str) -> Parameter:
    """A parameter with the 95 % interval of Student's t and what that says of it; without `se`, not identifiable."""
    if se is None:
        return Parameter(name, value, None, None, "not_identifiable", unit)
    reach = float(stdtrit(degrees, 0.975)) * se
    interval = (max(value - reach, 0.0), value + reach)  # no parameter of the law is negative
    return Parameter(name, value, se, interval, status_of(relative_error), unit)
