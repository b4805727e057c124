"""Profile likelihood: how the cost rises as one parameter moves and the others follow."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator
from scipy.optimize import brentq

from probation.identify.search import by_least_squares, search_range
from probation.identify.variable_projection import project, search
from probation.identify.weighting import SMALL_STEP
from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.identify.covariance import Covariance
    from probation.identify.weighting import Weighted
    from probation.inference.problem import Problem
    from probation.law.modal import Law

FIRST_STEP = 0.75
"""Distance of neighbouring points [standard errors]; it grows where the cost rises slowly."""

MOST_POINTS = 12
"""On each side."""

FINE_ENOUGH = 1e-7
"""Of the logarithm of tau_max, in the searches on the way."""


@dataclass(frozen=True, eq=False)
class Profile:
    """The profile of one parameter.

    Attributes
    ----------
    value : float
        The estimate.
    values : ndarray, shape (n_points,)
        Increasing; the estimate is one of them.
    root : ndarray, shape (n_points,) [-]
        Signed root of the rise of the cost, in standard deviations; a straight line where the problem is linear.
    quantile : float
        |root| at the ends of the interval: that of Student's t at 97.5 %.
    interval95 : (float, float)
        An end that the cost does not reach is the end of the parameter's own range.
    """

    name: str
    value: float
    values: FloatArray
    root: FloatArray
    quantile: float
    interval95: tuple[float, float]


def profile(
    weighted: Weighted,
    known: Covariance,
    index: int,
    quantile: float,
    limits: Mapping[str, tuple[float, float]],
) -> Profile:
    """The profile of the parameter number `index` of `law.parameters`.

    E_u and G are profiled out by variable projection (tau_max by Brent's method around it) where the residual's
    covariance is constant, all by Gauss-Newton where it moves with them. The cost is over its own scatter; where
    autocorrelated residuals widen the standard error, they widen the profile by the same factor.

    Parameters
    ----------
    weighted : Weighted
        The fit.
    known : Covariance
        Of its parameters.
    quantile : float
        Of Student's t at 97.5 %.
    limits : mapping of str to (float, float)
    """
    problem, law = weighted.problem, weighted.law
    name, value = law.parameter_names[index], float(law.parameters[index])
    free = problem.engine_law().free
    position = int(np.flatnonzero(free == index)[0])
    residual, jacobian = problem.residual_and_jacobian(weighted.parameters)
    least = float(residual @ residual)
    scatter = least / max(len(residual) - len(free), 1)
    error = known.standard_error(position)
    widened = 1.0
    if error is not None:
        size = np.linalg.norm(jacobian, axis=0)
        plain = np.linalg.pinv((jacobian / size).T @ (jacobian / size))[position, position] / size[position] ** 2
        widened = max(error / float(np.sqrt(scatter * plain)), 1.0)
        sides = []
    for sign in (-1.0, 1.0):
        step, at, there = FIRST_STEP * (error or 0.1 * abs(value) or 1.0), value, law
        points: list[tuple[float, float]] = []
        for count in range(MOST_POINTS):
            at += sign * step
            if not limits[name][0] < at < limits[name][1]:
                break
            there, cost = _best_jointly(problem, index, at, there, limits)
            rise = float(np.sqrt(max(cost - least, 0.0) / scatter)) / widened
            points.append((at, sign * rise))
            if rise > IDENTIFICATION.profile_reach * quantile:
                break
            if count > 4 or rise < 0.07 * quantile * (count + 1):
                step *= 2.0
        sides.append(points)
    both = np.array([*reversed(sides[0]), (value, 0.0), *sides[1]])
    values, root = both[:, 0], both[:, 1]
    ends = (
        _end(values, root, -quantile, limits[name][0]),
        _end(values, root, quantile, limits[name][1]),
    )
    return Profile(name, value, values, root, quantile, ends)


def _best_jointly(
    problem: Problem, index: int, value: float, near: Law, limits: Mapping[str, tuple[float, float]]
) -> tuple[Law, float]:
    """The law with one parameter at a value and the others at their best, from a law close by; and its cost."""
    values = near.parameters
    values[index] = value
    held = problem.with_law(problem.engine_law().holding(near.parameter_names[index], near.with_parameters(values)))
    if problem.moving is not None:
        parameters = by_least_squares(held, held.law.start, limits, tolerance=SMALL_STEP)
        cost = float(np.sum(held.residual(parameters) ** 2))
    elif index == 1:
        parameters, cost = project(held, value)
    else:
        ends = search_range(held, limits)
        parameters = search(held, ends, near=float(near.parameters[1]), tolerance=FINE_ENOUGH)
        cost = float(np.sum(held.residual(parameters) ** 2))
    return held.law_at(parameters), cost


def _end(values: FloatArray, root: FloatArray, level: float, beyond: float) -> float:
    """Where the root crosses a level; `beyond` where it does not."""
    side = root * np.sign(level) >= 0.0
    x, y = values[side], root[side]
    if np.max(np.abs(y)) < abs(level):
        return beyond
    kept = np.concatenate([[True], np.diff(y) > 0.0])
    curve = PchipInterpolator(x[kept], y[kept])
    return float(brentq(lambda at: float(curve(at)) - level, x[kept][0], x[kept][-1]))
