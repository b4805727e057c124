"""Law and effects fitted together: damped Gauss-Newton within bounds, priors of the effects included."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation.errors import ConvergenceError
from probation.inference.unsolvable import UNSOLVABLE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.inference.model import CampaignModel
    from probation.noise.whitener import Whitener

MOST_STEPS = 15
SETTLED = 0.02
"""A step that would lower the objective by less than this ends a search: little beside what noise does to it."""

LEAST_DAMPING, MOST_DAMPING = 1e-9, 1e9


@dataclass(frozen=True, eq=False)
class Refit:
    """A model at the optimum of chi^2 + prior.

    Attributes
    ----------
    model : CampaignModel
    parameters : ndarray, shape (p,)
    residual : ndarray, shape (N,)
        Whitened fit residual, model - data.
    jacobian : ndarray, shape (N, p)
        Whitened, along the search coordinates (see `Coordinates`).
    coordinates : Coordinates
    steps : int
        Gauss-Newton steps that were taken.
    """

    model: CampaignModel
    parameters: FloatArray
    residual: FloatArray
    jacobian: FloatArray
    coordinates: Coordinates
    steps: int

    @property
    def chi_square(self) -> float:
        """|L r|^2."""
        return float(self.residual @ self.residual)

    @property
    def at_bound(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which parameters ended at their lower, and which at their upper bound; each of shape (p,)."""
        return self.coordinates.at_bound(self.coordinates.of(self.parameters))


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Search coordinates: base parameters over their size, effects' as their priors have them (logarithms).

    Attributes
    ----------
    size : ndarray, shape (p,)
        Unit of each coordinate; 1 for effects.
    log : ndarray of bool, shape (p,)
    lower, upper : ndarray, shape (p,)
    ends : (ndarray, ndarray)
        The same for the parameters themselves.
    centre, precision : ndarray, shape (p,)
        Normal prior of each coordinate; precision 0 where it is flat.
    """

    size: FloatArray
    log: NDArray[np.bool_]
    lower: FloatArray
    upper: FloatArray
    ends: tuple[FloatArray, FloatArray]
    centre: FloatArray
    precision: FloatArray

    @classmethod
    def of_model(cls, model: CampaignModel) -> Coordinates:
        """Of a base law with its causes."""
        known, base = model.effect_parameters, model.base_count
        start = np.abs(model.law.start)
        size = np.append(np.where(start > 0.0, start, 1.0), np.ones(len(known)))
        log = np.array([False] * base + [each.log for each in known], dtype=bool)
        lower, upper = model.bounds
        centre = np.append(np.zeros(base), [each.to_search(each.centre) for each in known])
        scale = np.append(np.full(base, np.inf), [each.scale for each in known])
        made = cls(size, log, lower, upper, (lower, upper), centre, 1.0 / scale**2)
        return replace(made, lower=made.of(lower), upper=made.of(upper))

    def of(self, parameters: FloatArray) -> FloatArray:
        """Coordinates of parameters."""
        values = parameters / self.size
        values[self.log] = np.log(values[self.log])
        return np.asarray(values)

    def parameters(self, coordinates: FloatArray) -> FloatArray:
        """Parameters at coordinates."""
        values = coordinates.copy()
        values[self.log] = np.exp(values[self.log])
        return np.clip(values * self.size, *self.ends)

    def slopes(self, parameters: FloatArray) -> FloatArray:
        """Derivatives of the parameters along their coordinates."""
        return np.asarray(np.where(self.log, parameters, self.size))

    def at_bound(self, coordinates: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which coordinates lie at their lower, and which at their upper bound."""
        near = 1e-9 * np.maximum(1.0, np.abs(coordinates))
        return np.asarray(coordinates <= self.lower + near), np.asarray(coordinates >= self.upper - near)

    def pushed_out(self, coordinates: FloatArray, gradient: FloatArray) -> NDArray[np.bool_]:
        """Which lie at a bound and would lower an objective of this gradient beyond it."""
        low, high = self.at_bound(coordinates)
        return np.asarray((low & (gradient > 0.0)) | (high & (gradient < 0.0)))

    def penalty(self, coordinates: FloatArray) -> float:
        """-2 log of the priors' normal parts."""
        return float(self.precision @ (coordinates - self.centre) ** 2)


def refit(
    model: CampaignModel,
    start: FloatArray,
    whitener: Whitener,
    *,
    most_steps: int = MOST_STEPS,
    settled: float = SETTLED,
    held: NDArray[np.bool_] | None = None,
) -> Refit:
    """Minimise |L r|^2 + prior from a start, by Levenberg's and Marquardt's damping within the bounds.

    A parameter that wants beyond its bound is held there for the step (active set).

    Parameters
    ----------
    model : CampaignModel
    start : ndarray, shape (p,)
    whitener : Whitener
        Of the model's records.
    most_steps : int
        The search ends there, wherever it is: a race's early rounds.
    settled : float
        Least decrease of the objective that is worth a step.
    held : ndarray of bool, shape (p,), optional
        Parameters that stay at the start.

    Raises
    ------
    ConvergenceError
        If the law cannot be solved at the start.
    """
    coordinates = Coordinates.of_model(model)
    x = np.clip(coordinates.of(np.asarray(start, dtype=np.float64)), coordinates.lower, coordinates.upper)
    residual, jacobian = _tangent(model, x, coordinates, whitener)
    if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
        raise ConvergenceError(f"the law has no finite stress at the start of {', '.join(model.parameter_names)}")
    cost = float(residual @ residual) + coordinates.penalty(x)
    damping, steps = 1e-3, 0
    while steps < most_steps:
        moved = None
        gradient = jacobian.T @ residual + coordinates.precision * (x - coordinates.centre)
        free = ~coordinates.pushed_out(x, gradient)
        if held is not None:
            free &= ~held
        normal = (jacobian[:, free].T @ jacobian[:, free]) + np.diag(coordinates.precision[free])
        promise = np.inf
        while free.any() and damping < MOST_DAMPING:
            step = np.zeros(len(x))
            step[free] = -_solve(normal, gradient[free], damping)
            promise = -float(2.0 * gradient @ step) - float(step[free] @ normal @ step[free])
            if promise < settled:
                break
            tried = np.clip(x + step, coordinates.lower, coordinates.upper)
            moved = _moved(model, tried, coordinates, whitener, cost)
            if moved is not None:
                break
            damping *= 5.0
        if moved is None:
            break
        steps += 1
        gained = cost - moved.cost
        damping = max(damping / (10.0 if gained > 0.5 * promise else 2.0), LEAST_DAMPING)
        x, cost, residual, jacobian = moved
        if gained < settled:
            break
    return Refit(model, coordinates.parameters(x), residual, jacobian, coordinates, steps)


class _Point(NamedTuple):
    x: FloatArray
    cost: float
    residual: FloatArray
    jacobian: FloatArray


def _moved(
    model: CampaignModel, x: FloatArray, coordinates: Coordinates, whitener: Whitener, cost: float
) -> _Point | None:
    """The problem at x; None where the objective is not below `cost`, or the law, or its derivative, cannot be had."""
    try:
        residual = whitener.residual(model.residual(coordinates.parameters(x)))
        lower = float(residual @ residual) + coordinates.penalty(x)
        if not lower < cost:
            return None
        residual, jacobian = _tangent(model, x, coordinates, whitener)
    except UNSOLVABLE:
        return None
    return _Point(x, lower, residual, jacobian) if np.isfinite(jacobian).all() else None


def _tangent(
    model: CampaignModel, x: FloatArray, coordinates: Coordinates, whitener: Whitener
) -> tuple[FloatArray, FloatArray]:
    """Whitened residual, and its derivatives along the coordinates."""
    parameters = coordinates.parameters(x)
    raw, slopes = model.residual_and_jacobian(parameters)
    return whitener.residual(raw), whitener.columns(slopes * coordinates.slopes(parameters))


def _solve(normal: FloatArray, gradient: FloatArray, damping: float) -> FloatArray:
    """(N + damping diag N) step = gradient, scaled to a unit diagonal first."""
    size = np.sqrt(np.maximum(np.diag(normal), 1e-300))
    scaled = normal / np.outer(size, size)
    scaled[np.diag_indices_from(scaled)] += damping
    return np.asarray(np.linalg.lstsq(scaled, gradient / size, rcond=1e-14)[0] / size)
