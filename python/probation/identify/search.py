"""The three ways to the minimum: Gauss-Newton with the engine's sensitivities, variable projection, simplex."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import Bounds as SimplexBox
from scipy.optimize import minimize

from probation.identify.variable_projection import search, time_bounds
from probation.inference.least_squares import Bounds as Box
from probation.inference.least_squares import minimise

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping

    from probation._arrays import FloatArray
    from probation.inference.problem import Problem
    from probation.law.modal import Law

Bounds = tuple[float, float]

FINE = 1e-6
"""Step [standard errors] at which the search for a law ends: numbers that do not depend on where it began."""

LONGEST_STEP = 0.7
"""Largest change in one step, of the logarithm of tau_max and of a modulus over its start."""

ZERO = 1e-8
"""A modulus over its start below which the simplex has ended at 0."""


class _Scaled:
    """The identified parameters as a search sees them: moduli over their start, tau_max (or alpha) as a logarithm.

    A raw search can wander to tau_max < 0; this one cannot.
    """

    def __init__(self, problem: Problem, start: Law, bounds: Mapping[str, Bounds]) -> None:
        self.problem = problem
        self.names = [start.parameter_names[i] for i in problem.free]
        self.is_time = problem.free == 1
        values = start.parameters[problem.free]
        fallback = np.array([1000.0, 1.0, 1.0])[problem.free]
        self.size = np.where(values > 0.0, values, fallback)
        lower, upper = (np.array(ends) for ends in zip(*(bounds[name] for name in self.names), strict=True))
        self.lower, self.upper = self.to_search(lower), self.to_search(upper)
        self.start = np.clip(self.to_search(values), self.lower, self.upper)

    def to_search(self, values: FloatArray) -> FloatArray:
        with np.errstate(divide="ignore"):
            found: FloatArray = np.where(self.is_time, np.log(np.maximum(values, 0.0) / self.size), values / self.size)
        return found

    def law(self, x: FloatArray) -> Law:
        return self.problem.law_at(np.where(self.is_time, np.exp(x), x) * self.size)

    def ended(self, x: FloatArray) -> Law:
        """The law where a search ended; a modulus that the simplex left just above 0 is 0."""
        return self.law(np.where(~self.is_time & (x < ZERO), self.lower, x))

    def slopes(self, x: FloatArray) -> FloatArray:
        """Derivatives of the parameters with respect to x."""
        found: FloatArray = np.where(self.is_time, np.exp(x), 1.0) * self.size
        return found


def by_least_squares(
    problem: Problem,
    start: Law,
    bounds: Mapping[str, Bounds],
    *,
    tolerance: float = FINE,
    held: int | None = None,
) -> Law:
    """The law of least cost near a start, by Gauss-Newton with the engine's sensitivities.

    Where the noise moves with the law, so does the Sigma of the cost.

    Parameters
    ----------
    problem : Problem
    start : Law
    bounds : mapping of str to (float, float)
    tolerance : float
        Step [standard errors] at which the search ends.
    held : int, optional
        A parameter that does not move, by its number in `law.parameters`; others that do not are the problem's own.
    """
    if held is not None:
        problem = problem.with_held(held, start)
    if not problem.free.size:
        return start
    scaled = _Scaled(problem, start, bounds)
    found = minimise(
        _Cost(problem, scaled),
        scaled.start,
        bounds=Box(scaled.lower, scaled.upper),
        tolerance=tolerance,
        longest_step=LONGEST_STEP,
    )
    return scaled.law(found.x)


class _Cost:
    """The whitened residual along search coordinates; residual and derivatives come from one solve."""

    def __init__(self, problem: Problem, scaled: _Scaled) -> None:
        self.problem, self.scaled = problem, scaled
        self._kept: tuple[bytes, FloatArray, FloatArray] | None = None

    def residual(self, x: FloatArray) -> FloatArray:
        return self.tangent(x)[0]

    def tangent(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        key = x.tobytes()
        if self._kept is None or self._kept[0] != key:
            residual, jacobian = self.problem.residual_and_jacobian(self.scaled.law(x))
            self._kept = key, residual, jacobian[:, self.problem.free] * self.scaled.slopes(x)
        return self._kept[1:]


def by_simplex(problem: Problem, start: Law, bounds: Mapping[str, Bounds]) -> Law:
    """Nelder-Mead (scipy): slow, and independent of every derivative."""
    scaled = _Scaled(problem, start, bounds)
    found = scaled.start

    def cost(x: FloatArray) -> float:
        return float(np.sum(problem.residual(scaled.law(x)) ** 2))

    # A simplex can collapse in a narrow valley (E_u and tau_max are all but collinear): start it again until it stays.
    for _ in range(8):
        result = minimize(
            cost,
            found,
            method="Nelder-Mead",
            bounds=SimplexBox(scaled.lower, scaled.upper),
            options={"xatol": 1e-10, "fatol": 1e-12, "maxiter": 4000, "adaptive": True},
        )
        moved = float(np.max(np.abs(result.x - found)))
        found = result.x
        if moved < 1e-8:
            break
    return scaled.ended(found)


def first_guess(
    problem: Problem,
    bounds: Mapping[str, Bounds],
    progress: Callable[[float], None] | None = None,
    near: Law | None = None,
) -> Law:
    """The global minimum by variable projection; every method starts from it or is it.

    `near` is a law that is known to be close to it.
    """
    ends = search_range(problem, bounds)
    return search(problem, ends, progress, None if near is None else float(near.parameters[1]))


def search_range(problem: Problem, bounds: Mapping[str, Bounds]) -> Bounds:
    """Range of tau_max [s] (or alpha [-]) that is searched: the bounds, and where one is open, what is worth it."""
    low, high = time_bounds(problem)
    lower, upper = bounds.get(problem.law.parameter_names[1], (0.0, np.inf))
    if lower <= 0.0:
        lower = low if upper > low else low / high * upper
    if not np.isfinite(upper):
        upper = high if lower < high else high / low * lower
    return lower, upper
