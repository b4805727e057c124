"""p-values by bootstrap, and beyond its resolution."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc, ndtr, stdtr

from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation._arrays import FloatArray

MANY = 300
"""Points of the table that serves more values than that."""

_NODES, _WEIGHTS = np.polynomial.hermite_e.hermegauss(9)
_WEIGHTS = _WEIGHTS / _WEIGHTS.sum()


def normal_tail(size: FloatArray | float, spread: float = 0.0) -> FloatArray:
    """P(N > size), N normal with unit deviation times exp(spread * N(0, 1)): a level that is known so well."""
    scales = np.exp(spread * _NODES) if spread > 0.0 else np.ones(1)
    weights = _WEIGHTS if spread > 0.0 else np.ones(1)
    return np.asarray(ndtr(-np.divide.outer(size, scales)) @ weights, dtype=np.float64)


def student_tail(size: FloatArray | float, freedom: float) -> FloatArray:
    """P(T > size), T of unit variance and Student's t with so many degrees of freedom (above 2)."""
    if not np.isfinite(freedom):
        return normal_tail(size)
    return np.asarray(stdtr(freedom, -np.asarray(size) * np.sqrt(freedom / (freedom - 2.0))), dtype=np.float64)


def chi_square_tail(size: FloatArray | float, freedom: FloatArray | int, spread: float = 0.0) -> FloatArray:
    """P(chi^2 > size) under the same mixture of levels; many sizes at once by interpolating its logarithm."""
    values = np.asarray(size, dtype=np.float64)
    if values.size > MANY and np.ndim(freedom) == 0:
        grid = np.linspace(0.0, float(np.sqrt(values.max())), MANY)
        logs = np.log(np.maximum(chi_square_tail(grid**2, freedom, spread), 1e-300))
        return np.asarray(np.exp(np.interp(np.sqrt(values), grid, logs)), dtype=np.float64)
    scales = np.exp(2.0 * spread * _NODES) if spread > 0.0 else np.ones(1)
    weights = _WEIGHTS if spread > 0.0 else np.ones(1)
    ratio = np.divide.outer(size, scales)
    return np.asarray(chdtrc(np.asarray(freedom)[..., None], ratio) @ weights, dtype=np.float64)


def family_p_value(observed: FloatArray | float, drawn: FloatArray) -> FloatArray:
    """P(min p <= observed) from draws of the smallest p-value of a family (Westfall & Young, single step).

    Where fewer than `draws_beyond` draws lie below, P(min p <= x) is continued in proportion to x, as it is for any
    family of p-values far out; so the resolution has no end.

    Parameters
    ----------
    observed : float or ndarray
        p-values of single members.
    drawn : ndarray, shape (size,)
        The smallest one of each draw under the null.
    """
    ordered = np.sort(drawn)
    size = len(ordered)
    values = np.asarray(observed, dtype=np.float64)
    below = np.searchsorted(ordered, values, side="right")
    enough = min(DETECTION.draws_beyond, size)
    border = max(float(ordered[enough - 1]), 1e-300)
    continued = enough / size * np.minimum(values / border, 1.0)
    return np.asarray(np.where(below >= enough, (below + 1.0) / (size + 1.0), continued), dtype=np.float64)


def smallest_of_many(p_value: float, count: float) -> float:
    """P(min p <= p_value) of so many independent p-values (Sidak)."""
    return float(-np.expm1(count * np.log1p(-min(p_value, 1.0 - 1e-15))))
