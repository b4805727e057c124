"""Smoothing splines, segment by segment: strain and strain rate without a formula for either."""

from __future__ import annotations

from collections.abc import Callable
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from scipy.interpolate import make_smoothing_spline
from scipy.linalg import solveh_banded
from scipy.optimize import minimize_scalar

from probation.excitation.operators import Operators, joined

if TYPE_CHECKING:
    from probation._arrays import FloatArray

SHORTEST_SEGMENT = 6
"""Segments with fewer samples get a straight line."""

COARSE = 15
"""Points of the coarse search for the smoothness."""

STIFFEST = 1e10
"""Largest penalty: beyond it the equations lose their digits, and a few degrees of freedom cost nothing."""

FEW = 1500
"""Samples that the coarse search looks at, at most."""

PRUDENCE = 1.4
"""Each degree of freedom counts this often in the cross-validation, which otherwise follows the noise now and then."""


class Smoothed(NamedTuple):
    """Strain [-] and strain rate [1/s], both of shape (n_times,), and a call that makes their operators."""

    true_strain: FloatArray
    strain_rate: FloatArray
    operators: Callable[[], Operators]


def smooth_segments(time: FloatArray, true_strain: FloatArray, jumps: list[int]) -> Smoothed:
    """Cubic smoothing splines between the jumps, their smoothness chosen by generalised cross-validation.

    A jump belongs to both of its segments: its strain is the mean of the two, its rate the one before it.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    jumps : list of int
        Indices at which the rate jumps.

    Returns
    -------
    Smoothed
    """
    strain, rate = np.empty_like(true_strain), np.empty_like(true_strain)
    borders = [0, *jumps, len(time) - 1]
    meeting: dict[int, float] = {}
    blocks: list[Callable[[], Operators]] = []
    for first, last in pairwise(borders):
        part = slice(first, last + 1)
        values, slopes, operators = _smooth(time[part], true_strain[part])
        blocks.append(operators)
        if first in meeting:
            values[0] = 0.5 * (values[0] + meeting[first])
            strain[first] = values[0]
        keep = slice(first + (first > 0), last + 1)
        strain[keep], rate[keep] = values[keep.start - first :], slopes[keep.start - first :]
        meeting[last] = float(values[-1])
    return Smoothed(strain, rate, lambda: joined([block() for block in blocks], jumps, len(time)))


def _smooth(time: FloatArray, values: FloatArray) -> Smoothed:
    if len(time) < SHORTEST_SEGMENT:
        line = _line(time)
        return Smoothed(line.strain @ values, line.rate @ values, lambda: line)
    # Scaled to unit spacing and unit range, so that one range of smoothness serves every record.
    scale = (time[-1] - time[0]) / (len(time) - 1)
    span = float(np.ptp(values)) or 1.0
    t, y = (time - time[0]) / scale, values / span
    penalty = _smoothness(t, y)
    spline = make_smoothing_spline(t, y, lam=penalty)
    operators = partial(_spline_operators, t, penalty, scale)
    return Smoothed(spline(t) * span, spline.derivative()(t) * span / scale, operators)


def _line(time: FloatArray) -> Operators:
    """The least-squares straight line."""
    centred = time - time.mean()
    slope = centred / (centred @ centred)
    return Operators(np.outer(centred, slope) + 1.0 / len(time), np.tile(slope, (len(time), 1)))


def _spline_operators(time: FloatArray, penalty: float, scale: float) -> Operators:
    """Operators of the cubic smoothing spline in Reinsch's form; `time` over `scale` is what `penalty` belongs to.

    With the second derivatives c at the inner knots, (R + p Q^T Q) c = Q^T y and g = y - p Q c (Green & Silverman,
    Nonparametric Regression and Generalized Linear Models, 1994, sections 2.3 and 2.5).
    """
    step = np.diff(time)
    count = len(time)
    inner = np.arange(count - 2)
    Q = np.zeros((count, count - 2))
    Q[inner, inner] = 1.0 / step[:-1]
    Q[inner + 1, inner] = -1.0 / step[:-1] - 1.0 / step[1:]
    Q[inner + 2, inner] = 1.0 / step[1:]
    bands = np.zeros((3, count - 2))  # upper form: main diagonal last
    columns = np.stack([Q[inner + k, inner] for k in range(3)])
    bands[2] = (step[:-1] + step[1:]) / 3.0 + penalty * (columns**2).sum(axis=0)
    bands[1, 1:] = step[1:-1] / 6.0 + penalty * (columns[1, :-1] * columns[0, 1:] + columns[2, :-1] * columns[1, 1:])
    bands[0, 2:] = penalty * columns[2, :-2] * columns[0, 2:]
    curvature = np.zeros((count, count))
    curvature[1:-1] = solveh_banded(bands, Q.T)
    strain = np.eye(count) - penalty * (Q @ curvature[1:-1])
    rate = np.empty_like(strain)
    h = step[:, None]
    rate[:-1] = np.diff(strain, axis=0) / h - h / 6.0 * (2.0 * curvature[:-1] + curvature[1:])
    rate[-1] = (strain[-1] - strain[-2]) / step[-1] + step[-1] / 6.0 * (curvature[-2] + 2.0 * curvature[-1])
    return Operators(strain, rate / scale)


def _smoothness(time: FloatArray, values: FloatArray) -> float:
    """The penalty that generalised cross-validation (Craven & Wahba 1979) prefers; unit mean spacing."""
    stride = -(-len(time) // FEW)
    coarse = _Score(time[::stride] / stride, values[::stride])
    # The same curve on every k-th sample, in units of k samples, has its penalty divided by k^4.
    grid = np.linspace(np.log(1e-2), np.log(min(float(len(time)) ** 4, STIFFEST)), COARSE)
    scores = [coarse(point - 4.0 * np.log(stride)) for point in grid]
    best = int(np.argmin(scores))
    ends = (grid[max(best - 1, 0)], grid[min(best + 1, COARSE - 1)])
    found = minimize_scalar(_Score(time, values), bounds=ends, method="bounded", options={"xatol": 0.1})
    return float(np.exp(found.x))


class _Score:
    """Generalised cross-validation of a smoothing spline, as a function of the logarithm of its penalty.

    The degrees of freedom come from the spectrum of the cubic smoothing spline on an even grid, whose k-th penalty is
    (pi (k - 3/2) / n)^4.
    """

    def __init__(self, time: FloatArray, values: FloatArray) -> None:
        self.time, self.values = time, values
        self.penalties = (np.pi * (np.arange(2, len(time)) - 0.5) / len(time)) ** 4

    def __call__(self, log_penalty: float) -> float:
        penalty = float(np.exp(log_penalty))
        freedom = 2.0 + float(np.sum(1.0 / (1.0 + penalty * self.penalties)))
        left = 1.0 - PRUDENCE * freedom / len(self.time)
        if left <= 0.0:
            return np.inf
        residual = self.values - make_smoothing_spline(self.time, self.values, lam=penalty)(self.time)
        return float(np.mean(residual**2)) / left**2
