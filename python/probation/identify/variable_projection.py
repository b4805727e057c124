"""Variable projection: E_u and G enter the law linearly, so that only tau_max (or alpha) needs a search."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.scalar_minimum import non_negative, scalar_minimum
from probation.inference.time_range import time_range

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem

POINTS = 41
"""Points of the coarse search, evenly spaced in the logarithm."""

NEARBY = 1.5
"""Factor around a minimum that is known to be close within which it is looked for."""


def time_of(problem: Problem, parameters: FloatArray) -> float:
    """tau_max (or alpha) of the law with these parameters, identified or held."""
    return float(problem.law_at(parameters).parameters[1])


def project(problem: Problem, nonlinear: float) -> tuple[FloatArray, float]:
    """The best parameters at one tau_max (or alpha), and their cost; that time is the held one where it is held.

    The stress is E_u u + G v with unit solves u and v, where the noise does not move with the law. Where either best
    fit would be negative it is zero.

    Returns
    -------
    parameters : ndarray, shape (free,)
    cost : float
        Weighted sum of squares [-].
    """
    law = problem.engine_law()
    is_time = law.free == 1
    values = np.where(is_time, nonlinear, law.start)
    residual, jacobian = problem.residual_and_jacobian(values)
    columns = jacobian[:, ~is_time]
    target = columns @ values[~is_time] - residual
    if columns.shape[1]:
        # Two columns, thousands of rows: over their triangular factor, scaled to numbers near one.
        size = np.linalg.norm(columns, axis=0)
        size[size == 0.0] = 1.0
        factor: FloatArray = np.linalg.qr(np.column_stack([columns / size, target]))[1]
        values[~is_time] = non_negative(factor[:, :-1], factor[:, -1]) / size
    return values, float(np.sum((columns @ values[~is_time] - target) ** 2))


def search(
    problem: Problem,
    bounds: tuple[float, float],
    progress: Callable[[float], None] | None = None,
    near: float | None = None,
    tolerance: float = 1e-12,
) -> FloatArray:
    """The best parameters over a range of tau_max (or alpha), shape (free,): a coarse search, then Brent's method.

    Parameters
    ----------
    bounds : (float, float)
        [s] or [-].
    progress : callable, optional
        Called with the fraction done.
    near : float, optional
        Where the minimum is but for a factor of `NEARBY`: the coarse search is left out if it is there.
    tolerance : float
        Of the logarithm.
    """
    law = problem.engine_law()
    if 1 not in law.free:
        return project(problem, float(law.law.parameters[1]))[0]
    if near is not None:
        ends = (np.log(max(near / NEARBY, bounds[0])), np.log(min(near * NEARBY, bounds[1])))
        if ends[0] < ends[1]:
            minimum = _between(problem, ends, tolerance)
            reach = 1e-3 * (ends[1] - ends[0])
            if ends[0] + reach < minimum < ends[1] - reach:  # else the minimum is elsewhere
                return project(problem, float(np.exp(minimum)))[0]
    grid = np.linspace(np.log(bounds[0]), np.log(bounds[1]), POINTS)
    costs = []
    for done, point in enumerate(grid):
        costs.append(project(problem, float(np.exp(point)))[1])
        if progress:
            progress((done + 1) / POINTS)
    best = int(np.argmin(costs))
    low, high = grid[max(best - 1, 0)], grid[min(best + 1, POINTS - 1)]
    point = _between(problem, (low, high), tolerance)
    if project(problem, float(np.exp(point)))[1] > costs[best]:
        point = float(grid[best])
    return project(problem, float(np.exp(point)))[0]


def _between(problem: Problem, bounds: tuple[float, float], tolerance: float) -> float:
    """Logarithm of the tau_max (or alpha) of least cost between two logarithms, by Brent's method."""
    return scalar_minimum(lambda point: project(problem, float(np.exp(point)))[1], *bounds, tolerance)


def time_bounds(problem: Problem) -> tuple[float, float]:
    """Range of tau_max [s] (or alpha [-]) worth searching: from far below a sample to far beyond the record."""
    return time_range([view.record for view in problem.views], problem.engine_law().law)
