r"""How often the right one of two effects fits the data better (docs/diagnosis-method.md, section 5).

An effect's whitened, projected signal has the length sqrt(lambda) along the unit vector u_i; the rival's is u_j, at the
angle psi. With t = u^T z the better of the two has the larger t^2 (a one-sided amplitude: of max(t, 0)^2). The sign of
t_i - t_j and that of t_i + t_j are independent: u_i - u_j and u_i + u_j are orthogonal, and z has mean
sqrt(lambda) sin(psi/2) along one, sqrt(lambda) cos(psi/2) along the other.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtr, owens_t

if TYPE_CHECKING:
    from numpy.typing import ArrayLike

    from probation._arrays import FloatArray


def probability_of_the_right_one(
    root_lambda: ArrayLike, cosine: ArrayLike, *, one_sided: bool = False, rival_one_sided: bool = False
) -> FloatArray:
    """Probability that the effect that is there describes the data better than the rival does.

    Parameters
    ----------
    root_lambda : array_like
        Length of the effect's signal, in standard deviations of the noise.
    cosine : array_like
        Of the angle between the two signals, each taken in the direction that its amplitude allows.
    one_sided, rival_one_sided : bool
        Whether the amplitude of the effect, of the rival, can have one sign only.

    Returns
    -------
    ndarray
        0.5 where the two are the same; a draw counts as half.
    """
    length = np.asarray(root_lambda, dtype=np.float64)
    c = np.clip(np.asarray(cosine, dtype=np.float64), -1.0, 1.0)
    sine_of_half, cosine_of_half = np.sqrt(0.5 * (1.0 - c)), np.sqrt(0.5 * (1.0 + c))
    apart, together = length * sine_of_half, length * cosine_of_half
    if one_sided and rival_one_sided:
        # t_i > 0 and t_i > t_j, whose correlation is sin(psi/2): Owen 1956. Both t < 0: a draw.
        ahead = 0.5 * (ndtr(length) + ndtr(apart)) - owens_t(apart, _ratio(cosine_of_half, sine_of_half))
        neither = 0.5 * (ndtr(-length) + ndtr(-c * length)) - 0.5 * ((c < 0.0) & (length > 0.0))
        neither = neither - owens_t(c * length, _ratio(np.sqrt(1.0 - c**2), c))
        return np.asarray(ahead + 0.5 * neither, dtype=np.float64)
    if one_sided:
        return np.asarray(ndtr(apart) * ndtr(together), dtype=np.float64)
    if rival_one_sided:
        return np.asarray(1.0 - ndtr(-apart) * ndtr(together), dtype=np.float64)
    return np.asarray(ndtr(apart) * ndtr(together) + ndtr(-apart) * ndtr(-together), dtype=np.float64)


def best_match(
    length: float, products: FloatArray, sizes: FloatArray, lower: FloatArray, upper: FloatArray
) -> FloatArray:
    """How well multiples of each rival, within their bounds, look like a signal.

    Parameters
    ----------
    length : float
        Of the signal, whitened and projected.
    products : ndarray, shape (m,)
        Scalar products of the signal with the rivals, each at one unit of its amplitude.
    sizes : ndarray, shape (m,)
        Lengths of the rivals.
    lower, upper : ndarray, shape (m,)
        Bounds of the amplitudes in those units, lower <= 0 <= upper.

    Returns
    -------
    ndarray, shape (m,)
        Cosine of the angle, taken in the allowed direction: a one-sided rival's may be negative; it is made smaller
        where the bounds do not let the rival grow to the signal.
    """
    if length == 0.0:
        return np.zeros(len(sizes))
    present = sizes > 0.0
    safe = np.where(present, sizes, 1.0)
    wanted = np.where(present, products / safe**2, 0.0)
    amplitude = np.clip(wanted, lower, upper)
    # |signal - a rival|^2 = lambda sin^2: the angle that the distance is worth.
    taken = (2.0 * wanted * amplitude - amplitude**2) * (safe / length) ** 2
    reached = np.sqrt(np.clip(taken, 0.0, 1.0))
    forbidden = ((lower == 0.0) | (upper == 0.0)) & (amplitude == 0.0)
    return np.asarray(np.where(forbidden, -np.abs(wanted) * safe / length, reached), dtype=np.float64)


def _ratio(numerator: FloatArray, denominator: FloatArray) -> FloatArray:
    """Numerator over denominator, infinite where that is 0."""
    filled = np.full(np.broadcast(numerator, denominator).shape, np.inf)
    return np.asarray(np.divide(numerator, denominator, out=filled, where=denominator != 0.0), dtype=np.float64)
