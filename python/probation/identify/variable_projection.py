"""Variable projection: E_u and G enter the law linearly, so that only tau_max (or alpha) needs a search."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar, nnls

from probation.inference.time_range import time_range

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem
    from probation.law.modal import Law

POINTS = 41
"""Points of the coarse search, evenly spaced in the logarithm."""

NEARBY = 1.5
"""Factor around a minimum that is known to be close within which it is looked for."""

EDGE = 1.05
"""A minimum within this factor of an end of the range is at its edge."""


def project(problem: Problem, nonlinear: float) -> tuple[Law, float]:
    """The best law at one tau_max (or alpha), and its cost.

    The stress is E_u u + G v with unit solves u and v, where the noise does not move with the law. Where either best
    fit would be negative it is zero.

    Returns
    -------
    law : Law
    cost : float
        Weighted sum of squares [-].
    """
    base = problem.law.parameters
    base[1] = nonlinear
    law = problem.law.with_parameters(base)
    _, jacobian = problem.residual_and_jacobian(law)
    data = problem.data(law)
    columns = jacobian[:, [0, 2]]
    held = np.array([problem.held[0], problem.held[2]])
    values = base[[0, 2]]
    target = data - columns[:, held] @ values[held]
    if not held.all():
        # Over the normal equations: two columns, thousands of rows. Scaled, so that nnls sees numbers near one.
        free = columns[:, ~held]
        size = np.linalg.norm(free, axis=0)
        size[size == 0.0] = 1.0
        factor: FloatArray = np.linalg.qr(np.column_stack([free / size, target]))[1]
        values[~held] = nnls(factor[:, :-1], factor[:, -1])[0] / size
    base[[0, 2]] = values
    return problem.law.with_parameters(base), float(np.sum((columns @ values - data) ** 2))


def search(
    problem: Problem,
    bounds: tuple[float, float],
    progress: Callable[[float], None] | None = None,
    near: float | None = None,
    tolerance: float = 1e-12,
) -> Law:
    """The best law over a range of tau_max (or alpha): a coarse search, then Brent's method around its minimum.

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
    if problem.held[1]:
        return project(problem, float(problem.law.parameters[1]))[0]
    if near is not None:
        ends = (np.log(max(near / NEARBY, bounds[0])), np.log(min(near * NEARBY, bounds[1])))
        if ends[0] < ends[1]:
            found = _between(problem, ends, tolerance)
            reach = 1e-3 * (ends[1] - ends[0])
            if ends[0] + reach < found < ends[1] - reach:  # else the minimum is elsewhere
                return project(problem, float(np.exp(found)))[0]
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
    found = minimize_scalar(
        lambda point: project(problem, float(np.exp(point)))[1],
        bounds=bounds,
        method="bounded",
        options={"xatol": tolerance},
    )
    return float(found.x)


def time_bounds(problem: Problem) -> tuple[float, float]:
    """Range of tau_max [s] (or alpha [-]) worth searching: from far below a sample to far beyond the record."""
    return time_range([each.record for each in problem.records], problem.law)
