"""Nonlinear least squares: Gauss-Newton steps, damped after Levenberg and Marquardt, within bounds.

One search for the law's parameters, for effects with priors and for relations; tested by itself on problems with known
answers.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple, Protocol

import numpy as np

from probation.errors import ConvergenceError
from probation.inference.unsolvable import UNSOLVABLE

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray

FIRST_DAMPING, LEAST_DAMPING, MOST_DAMPING = 1e-3, 1e-9, 1e9
"""Of the normal matrix with a unit diagonal: after a first step that fails, in the end, and where a search gives up."""

ALL_DIGITS = 1e-13
"""Step over a coordinate's size at which nothing is left to find."""


class Objective(Protocol):
    """Residuals r(x) whose sum of squares is to be least.

    Where there is no answer either method raises one of `UNSOLVABLE`, or gives numbers that are not finite: the search
    turns back.
    """

    def residual(self, x: FloatArray) -> FloatArray:
        """Shape (n,)."""

    def tangent(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Residual (n,) and its derivatives (n, p)."""


@dataclass(frozen=True, eq=False)
class NormalPrior:
    """Independent normal priors of the coordinates.

    Attributes
    ----------
    centre, precision : ndarray, shape (p,)
        Precision is one over the variance; 0 where the prior is flat.
    """

    centre: FloatArray
    precision: FloatArray

    @classmethod
    def flat(cls, count: int) -> NormalPrior:
        """None on so many coordinates."""
        return cls(np.zeros(count), np.zeros(count))

    def penalty(self, x: FloatArray) -> float:
        """-2 log density, without constants."""
        return float(self.precision @ (x - self.centre) ** 2)


@dataclass(frozen=True, eq=False)
class Bounds:
    """A box of coordinates.

    Attributes
    ----------
    lower, upper : ndarray, shape (p,)
    """

    lower: FloatArray
    upper: FloatArray

    @classmethod
    def none(cls, count: int) -> Bounds:
        """No bounds on so many coordinates."""
        return cls(np.full(count, -np.inf), np.full(count, np.inf))

    def clip(self, x: FloatArray) -> FloatArray:
        """The nearest point within."""
        return np.clip(x, self.lower, self.upper)

    def reached(self, x: FloatArray) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which coordinates lie at their lower, and which at their upper bound."""
        near = 1e-9 * np.maximum(1.0, np.abs(x))
        return np.asarray(x <= self.lower + near), np.asarray(x >= self.upper - near)

    def pushed_out(self, x: FloatArray, gradient: FloatArray) -> NDArray[np.bool_]:
        """Which lie at a bound and would lower an objective of this gradient beyond it."""
        low, high = self.reached(x)
        return np.asarray((low & (gradient > 0.0)) | (high & (gradient < 0.0)))


@dataclass(frozen=True, eq=False)
class Minimum:
    """Where a search ended.

    Attributes
    ----------
    x : ndarray, shape (p,)
    cost : float
        Sum of squares and the prior's penalty.
    steps : int
        That were taken.
    objective : Objective
    known : (ndarray, ndarray) or None
        Its tangent here; None where it was not asked for.
    """

    x: FloatArray
    cost: float
    steps: int
    objective: Objective
    known: tuple[FloatArray, FloatArray] | None = None

    @cached_property
    def tangent(self) -> tuple[FloatArray, FloatArray]:
        """Residual (n,) and its derivatives (n, p); it raises what the objective does where it has none."""
        return self.objective.tangent(self.x) if self.known is None else self.known

    @property
    def residual(self) -> FloatArray:
        """Shape (n,)."""
        return self.tangent[0]

    @property
    def jacobian(self) -> FloatArray:
        """Shape (n, p)."""
        return self.tangent[1]


def minimise(
    objective: Objective,
    start: FloatArray,
    *,
    tangent: tuple[FloatArray, FloatArray] | None = None,
    bounds: Bounds | None = None,
    prior: NormalPrior | None = None,
    held: NDArray[np.bool_] | None = None,
    settled: float = 0.0,
    tolerance: float = 0.0,
    damping: float = 0.0,
    longest_step: float = np.inf,
    most_steps: int = 100,
    tangent_at_end: bool = True,
) -> Minimum:
    """Minimise r(x)^T r(x) + prior from a start.

    A coordinate that wants beyond its bound stays there for the step (active set). Steps that do not lower the
    objective are tried again with more damping.

    Parameters
    ----------
    objective : Objective
    start : ndarray, shape (p,)
        Moved into the bounds.
    tangent : (ndarray, ndarray), optional
        The objective's there, where it is known.
    bounds : Bounds, optional
    prior : NormalPrior, optional
    held : ndarray of bool, shape (p,), optional
        Coordinates that stay at the start.
    settled : float
        Least decrease of the objective that is worth a step.
    tolerance : float
        The same as a step [standard errors of the estimate, by the scatter of the residuals].
    damping : float
        Of the first step; 0 for Gauss-Newton's own.
    longest_step : float
        Largest change of a coordinate in one step.
    most_steps : int
        The search ends there, wherever it is.
    tangent_at_end : bool
        Whether the last of these steps ends where the objective has a derivative. That costs more than the step; where
        only the place matters, it may be left out.

    Raises
    ------
    ConvergenceError
        If the objective is not finite at the start. What it raises there itself passes through.
    """
    bounds = Bounds.none(len(start)) if bounds is None else bounds
    prior = NormalPrior.flat(len(start)) if prior is None else prior
    movable = np.ones(len(start), dtype=bool) if held is None else ~held
    x = bounds.clip(np.asarray(start, dtype=np.float64))
    residual, jacobian = objective.tangent(x) if tangent is None else tangent
    if not (np.isfinite(residual).all() and np.isfinite(jacobian).all()):
        raise ConvergenceError("the model is not finite at the start")
    here = _Point(x, float(residual @ residual) + prior.penalty(x), (residual, jacobian))
    first, floor, steps = damping, min(damping, LEAST_DAMPING), 0
    while steps < most_steps and here.tangent is not None:
        residual, jacobian = here.tangent
        least = max(settled, tolerance**2 * float(residual @ residual) / max(len(residual) - len(x), 1))
        gradient = jacobian.T @ residual + prior.precision * (here.x - prior.centre)
        free = movable & ~bounds.pushed_out(here.x, gradient)
        along = jacobian[:, free]
        normal = along.T @ along + np.diag(prior.precision[free])
        moved, promise, mildest = None, np.inf, damping
        while free.any() and damping < MOST_DAMPING:
            step = np.zeros(len(x))
            step[free] = -_solved(normal, gradient[free], damping)
            step *= longest_step / max(float(np.max(np.abs(step))), longest_step) if longest_step < np.inf else 1.0
            promise = -float(2.0 * gradient @ step) - float(step[free] @ normal @ step[free])
            if promise < least or np.all(np.abs(step) <= ALL_DIGITS * np.maximum(np.abs(here.x), 1.0)):
                if mildest <= first:
                    break
                damping = mildest = first  # damped, a step says little of what is left to gain
                continue
            differentiable = tangent_at_end or steps + 1 < most_steps
            moved = _moved(objective, bounds.clip(here.x + step), prior, here.cost, differentiable)
            if moved is not None:
                break
            damping = max(5.0 * damping, FIRST_DAMPING)
        if moved is None:
            break
        steps += 1
        gained, used = here.cost - moved.cost, damping
        damping = max(damping / (10.0 if gained > 0.5 * promise else 2.0), floor)
        here = moved
        if gained < least and used <= first:
            break
    return Minimum(here.x, here.cost, steps, objective, here.tangent)


class _Point(NamedTuple):
    x: FloatArray
    cost: float
    tangent: tuple[FloatArray, FloatArray] | None


def _moved(objective: Objective, x: FloatArray, prior: NormalPrior, cost: float, differentiable: bool) -> _Point | None:
    """The problem at x, with its tangent where it is to have one.

    None where the objective is not below `cost`, or it, or the derivative that is needed, cannot be had.
    """
    try:
        residual = objective.residual(x)
        with np.errstate(over="ignore"):  # a step that went too far
            lower = float(residual @ residual) + prior.penalty(x)
        if not lower < cost:
            return None
        tangent = objective.tangent(x) if differentiable else None
    except UNSOLVABLE:
        return None
    return None if tangent is not None and not np.isfinite(tangent[1]).all() else _Point(x, lower, tangent)


def _solved(normal: FloatArray, gradient: FloatArray, damping: float) -> FloatArray:
    """(N + damping diag N) step = gradient, scaled to a unit diagonal first."""
    size = np.sqrt(np.maximum(np.diag(normal), 1e-300))
    scaled = normal / np.outer(size, size)
    scaled[np.diag_indices_from(scaled)] += damping
    if damping >= LEAST_DAMPING and np.isfinite(scaled).all():
        return np.asarray(np.linalg.solve(scaled, gradient / size) / size)
    return np.asarray(np.linalg.lstsq(scaled, gradient / size, rcond=1e-14)[0] / size)
