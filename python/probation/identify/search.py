"""The three ways to the minimum: Gauss-Newton with the engine's sensitivities, variable projection, simplex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.variable_projection import search, time_bounds, time_of
from probation.inference.least_squares import NormalPrior, minimise
from probation.inference.refit import Coordinates, SearchResidual

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem

Bounds = tuple[float, float]

FINAL_STEP = 1e-6
"""Step [standard errors] at which the search for a law ends: numbers that do not depend on where it began."""

LONGEST_STEP = 0.7
"""Largest change in one step, of the logarithm of tau_max and of a modulus over its start."""

ZERO = 1e-8
"""A modulus over its start below which the simplex has ended at 0."""


def coordinates_of(problem: Problem, start: FloatArray, bounds: Mapping[str, Bounds]) -> Coordinates:
    """Search coordinates of a law's parameters: moduli over their start, tau_max (or alpha) over its as a logarithm.

    A raw search can wander to tau_max < 0; this one cannot.
    """
    law = problem.engine_law()
    size = np.where(start > 0.0, start, np.array([1000.0, 1.0, 1.0])[law.free])
    lower, upper = np.array([bounds[name] for name in law.names]).T
    return Coordinates(size, law.free == 1, (lower, upper), NormalPrior.flat(len(size)))


def by_least_squares(
    problem: Problem, start: FloatArray, bounds: Mapping[str, Bounds], *, tolerance: float = FINAL_STEP
) -> FloatArray:
    """The parameters of least cost near a start, by Gauss-Newton with the engine's sensitivities; shape (free,).

    Where the noise moves with the law, so does the Sigma of the cost.

    Parameters
    ----------
    start : ndarray, shape (free,)
    bounds : mapping of str to (float, float)
    tolerance : float
        Step [standard errors] at which the search ends.
    """
    if not start.size:
        return start
    coordinates = coordinates_of(problem, start, bounds)
    minimum = minimise(
        SearchResidual(problem, coordinates),
        coordinates.of(start),
        bounds=coordinates.bounds,
        tolerance=tolerance,
        longest_step=LONGEST_STEP,
    )
    return coordinates.parameters(minimum.x)


def by_simplex(problem: Problem, start: FloatArray, bounds: Mapping[str, Bounds]) -> FloatArray:
    """Nelder-Mead (scipy): slow, and independent of every derivative."""
    from scipy.optimize import Bounds as SimplexBox  # noqa: PLC0415 - slow to load, and this is one way of several
    from scipy.optimize import minimize  # noqa: PLC0415

    coordinates = coordinates_of(problem, start, bounds)
    objective, box = SearchResidual(problem, coordinates), coordinates.bounds
    best = box.clip(coordinates.of(start))

    def cost(x: FloatArray) -> float:
        return float(np.sum(objective.residual(x) ** 2))

    # A simplex can collapse in a narrow valley (E_u and tau_max are all but collinear): start it again until it stays.
    for _ in range(8):
        result = minimize(
            cost,
            best,
            method="Nelder-Mead",
            bounds=SimplexBox(box.lower, box.upper),
            options={"xatol": 1e-10, "fatol": 1e-12, "maxiter": 4000, "adaptive": True},
        )
        moved = float(np.max(np.abs(result.x - best)))
        best = result.x
        if moved < 1e-8:
            break
    # A modulus that the simplex left just above 0 is 0.
    return coordinates.parameters(np.where(~coordinates.log & (best < ZERO), box.lower, best))


def first_guess(
    problem: Problem,
    bounds: Mapping[str, Bounds],
    progress: Callable[[float], None] | None = None,
    near: FloatArray | None = None,
) -> FloatArray:
    """The global minimum by variable projection, shape (free,); every method starts from it or is it.

    `near` is known to be close to it.
    """
    ends = search_range(problem, bounds)
    return search(problem, ends, progress, None if near is None else time_of(problem, near))


def search_range(problem: Problem, bounds: Mapping[str, Bounds]) -> Bounds:
    """Range of tau_max [s] (or alpha [-]) that is searched: the bounds, and where one is open, what is worth it."""
    low, high = time_bounds(problem)
    lower, upper = bounds.get(problem.engine_law().law.parameter_names[1], (0.0, np.inf))
    if lower <= 0.0:
        lower = low if upper > low else low / high * upper
    if not np.isfinite(upper):
        upper = high if lower < high else high / low * lower
    return lower, upper
