"""The minimum of a function of one variable between two ends, and moduli that may not be negative.

Both as in scipy.optimize, which takes longer to load than most fits take to compute.
"""

from __future__ import annotations

from itertools import combinations
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray

GOLDEN = 0.5 * (3.0 - np.sqrt(5.0))
ROUNDING = float(np.sqrt(np.finfo(np.float64).eps))
MOST_CALLS = 500


def scalar_minimum(function: Callable[[float], float], low: float, high: float, tolerance: float) -> float:
    """Where a function is least, by Brent's method: parabolas through three points, else golden sections (1973).

    Parameters
    ----------
    function : callable
    low, high : float
    tolerance : float
        Of the place.
    """
    best = second = third = low + GOLDEN * (high - low)
    at_best = at_second = at_third = function(best)
    step = before = 0.0
    for _ in range(MOST_CALLS):
        middle = 0.5 * (low + high)
        least = ROUNDING * abs(best) + tolerance / 3.0
        if abs(best - middle) <= 2.0 * least - 0.5 * (high - low):
            break
        parabolic = False
        if abs(before) > least:
            r = (best - second) * (at_best - at_third)
            q = (best - third) * (at_best - at_second)
            p = (best - third) * q - (best - second) * r
            q = 2.0 * (q - r)
            p, q = (-p, q) if q > 0.0 else (p, -q)
            parabolic = abs(p) < abs(0.5 * q * before) and q * (low - best) < p < q * (high - best)
            before = step
        if parabolic:
            step = p / q
            place = best + step
            if min(place - low, high - place) < 2.0 * least:
                step = least if middle >= best else -least
        else:
            before = low - best if best >= middle else high - best
            step = GOLDEN * before
        place = best + (1.0 if step >= 0.0 else -1.0) * max(abs(step), least)
        value = function(place)
        if value <= at_best:
            low, high = (best, high) if place >= best else (low, best)
            third, at_third, second, at_second, best, at_best = second, at_second, best, at_best, place, value
            continue
        low, high = (place, high) if place < best else (low, place)
        if value <= at_second or second == best:
            third, at_third, second, at_second = second, at_second, place, value
        elif value <= at_third or third in (best, second):
            third, at_third = place, value
    return float(best)


def non_negative(columns: FloatArray, target: FloatArray) -> FloatArray:
    """Least squares with coefficients of at least 0, for a few columns: the best of all sets of columns that allow it.

    Parameters
    ----------
    columns : ndarray, shape (n, m)
    target : ndarray, shape (n,)

    Returns
    -------
    ndarray, shape (m,)
    """
    count = columns.shape[1]
    best, least = np.zeros(count), float(target @ target)
    for size in range(count, 0, -1):
        for kept in map(list, combinations(range(count), size)):
            values = np.linalg.lstsq(columns[:, kept], target, rcond=None)[0]
            square = float(np.sum((columns[:, kept] @ values - target) ** 2))
            if values.min() >= 0.0 and square < least:
                best, least = np.zeros(count), square
                best[kept] = values
        if size == count and best.any():
            break  # all of them: fewer leave more
    return best
