"""Whether a strain's noise is averaged over neighbouring samples, as in a video extensometer; decided before smoothing.

A smoother that begins by taking the noise as white follows averaged noise, and what it leaves no longer shows it.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from math import comb
from typing import TYPE_CHECKING

import numpy as np

from probation.records.noise import robust_deviation
from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from probation._arrays import FloatArray

PART = 16
"""... and that part of all samples."""

BEYOND = 2

FURTHER = 3
"""Samples over which averages of any length show by fourth differences: 2.4 to 5 times the variance over one."""

ORDERS = (2, 4)
"""Of the differences; the higher one, of fewer lags, where the lower one still sees the curve."""


@dataclass(frozen=True)
class Averaging:
    """How an extensometer averages its noise.

    Attributes
    ----------
    inflation : float
        Variance of slow averages of the noise over what white noise would have: 1 + 2 sum of the autocorrelation, 1 if
        it is white.
    hidden : float
        Variance of the noise over what differences of neighbours show of it; 1 if it is white.
    """

    inflation: float = 1.0
    hidden: float = 1.0

    @classmethod
    def pooled(cls, segments: Iterable[FloatArray]) -> Averaging:
        """Of segments whose strains have one extensometer.

        In some of them the curve hides an average that others show; in some, a machine that wanders looks like one. So
        it is the median of those whose noise shows, averaged or white, weighted by their samples; white if none does.
        """
        estimates = [(len(values), averaging) for values in segments if (averaging := averaging_of(values)) is not None]
        if not estimates:
            return cls()
        samples = [count for count, _ in estimates]
        return cls(
            weighted_median([estimate.inflation for _, estimate in estimates], samples),
            weighted_median([estimate.hidden for _, estimate in estimates], samples),
        )


def weighted_median(values: Sequence[float], weights: Sequence[float]) -> float:
    """Where one half of the weight lies on either side, between the two values next to it.

    Parameters
    ----------
    values, weights : sequence of float, length n
        Of at least one value; weights are positive.
    """
    order = np.argsort(values)
    ordered, weight = np.asarray(values)[order], np.asarray(weights)[order]
    return float(np.interp(0.5, (np.cumsum(weight) - 0.5 * weight) / weight.sum(), ordered))


def segments_of(values: FloatArray, jumps: Sequence[int]) -> Iterator[FloatArray]:
    """What lies between jumps of the slope, the samples at the jumps left out."""
    for before, after in pairwise([-1, *jumps, len(values)]):
        yield values[before + 1 : after]


def averaging_of(values: FloatArray) -> Averaging | None:
    r"""How the noise of one segment is averaged.

    By second differences over lags k, whose variance is :math:`6\gamma_0 - 8\gamma_k + 2\gamma_{2k}`: constant for
    white noise, in proportion to k up to the length of an average and constant beyond. That of a smooth curve grows as
    the fourth power of k; where it does, or no level is reached, fourth differences may still show it. None if neither
    does. A machine that wanders looks like an average to second differences, whose variance then grows in proportion to
    k, too; but fourth differences over three samples are then hardly larger than those over one.

    Parameters
    ----------
    values : ndarray, shape (n,)
        At even intervals or nearly so, without a jump of the slope.
    """
    if len(values) <= FURTHER * ORDERS[-1]:
        return None
    orders = ORDERS[-1:] if _neighbours_are_independent(values) else ORDERS
    estimates = [averaging for order in orders if (averaging := _by_differences(values, order)) is not None]
    return max(estimates, key=lambda estimate: estimate.inflation) if estimates else None


def _neighbours_are_independent(values: FloatArray) -> bool:
    near, further = (_variance(values, lag, ORDERS[-1]) for lag in (1, FURTHER))
    return further < SMOOTHING.white_neighbours * near


def _by_differences(values: FloatArray, order: int) -> Averaging | None:
    most = min(SMOOTHING.longest_average, len(values) // (PART * order)) * BEYOND
    if most < 2 * BEYOND:
        return None
    weights = _autocorrelated(order)
    variance = np.array([_variance(values, lag, order) for lag in range(1, most + 1)])
    if variance[0] == 0.0:
        return None
    for lag in range(1, most // BEYOND + 1):
        here = variance[lag - 1]
        if variance[2 * lag - 1] > SMOOTHING.rough * here:
            return None
        if np.max(variance[lag - 1 : BEYOND * lag]) <= SMOOTHING.levelled * here:
            level = float(np.median(variance[lag - 1 : BEYOND * lag]))
            return Averaging(_inflation(variance[: lag - 1], level, weights), max(level / float(variance[0]), 1.0))
    return None


def _autocorrelated(order: int) -> FloatArray:
    """What the variance of differences has of each autocorrelation gamma_0, gamma_k, gamma_2k, ...; (order + 1,)."""
    kernel = np.array([comb(order, at) * (-1.0) ** at for at in range(order + 1)])
    whole = np.correlate(kernel, kernel, mode="full")[order:]
    whole[1:] *= 2.0
    return np.asarray(whole)


def _variance(values: FloatArray, lag: int, order: int) -> float:
    """Robust variance of differences over a lag."""
    for _ in range(order):
        values = values[lag:] - values[:-lag]
    return robust_deviation(values) ** 2


def _inflation(variance: FloatArray, level: float, weights: FloatArray) -> float:
    """From the variances below the lag at which they come to their level."""
    count, order = len(variance), len(weights) - 1
    correlation = np.zeros(order * count + 1)
    for lag in range(count, 0, -1):
        others = float(weights[2:] @ correlation[2 * lag : order * lag + 1 : lag])
        known = (weights[0] * (variance[lag - 1] / level - 1.0) - others) / weights[1]
        correlation[lag] = min(max(known, 0.0), 1.0)
    return 1.0 + 2.0 * float(correlation[1:].sum())
