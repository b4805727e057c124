"""Law and effects fitted together, within bounds and with the priors of the effects."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation.inference.candidate import cause_key
from probation.inference.least_squares import FIRST_DAMPING, Bounds, Minimum, NormalPrior, minimise
from probation.noise.span import span_of
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.inference.candidate import Key
    from probation.inference.model import CampaignModel
    from probation.inference.problem import Problem

MOST_STEPS = 15


class Ended(NamedTuple):
    """Where a refit ended: its data, without the problem, as another process hands it back. As in `Refit`."""

    parameters: FloatArray
    residual: FloatArray
    jacobian: FloatArray


@dataclass(frozen=True, eq=False)
class Refit:
    """A problem at the optimum of chi^2 + prior.

    Attributes
    ----------
    problem : Problem
    parameters : ndarray, shape (p,)
    residual : ndarray, shape (N,)
        Whitened fit residual, model - data.
    jacobian : ndarray, shape (N, p)
        Whitened, along the search coordinates (see `Coordinates`).
    """

    problem: Problem
    parameters: FloatArray
    residual: FloatArray
    jacobian: FloatArray

    @classmethod
    def of(cls, problem: Problem, ended: Ended) -> Refit:
        """A problem, and where its refit ended."""
        return cls(problem, *ended)

    @cached_property
    def coordinates(self) -> Coordinates:
        """Of the search."""
        return Coordinates.of_model(self.model)

    @property
    def ended(self) -> Ended:
        """Its data."""
        return Ended(self.parameters, self.residual, self.jacobian)

    @property
    def model(self) -> CampaignModel:
        """Law, records and effects."""
        return self.problem.model

    @cached_property
    def keys(self) -> frozenset[Key]:
        """Of its causes."""
        return frozenset(cause_key(cause) for cause in self.model.causes)

    @property
    def chi_square(self) -> float:
        """|L r|^2."""
        return float(self.residual @ self.residual)

    @cached_property
    def not_reached(self) -> float:
        """Half of what further steps would take off the objective, were the law linear; 0 at an optimum.

        More than that where a search ended since the law does not follow the linearised one.
        """
        x, prior = self.coordinates.of(self.parameters), self.coordinates.prior
        gradient = self.jacobian.T @ self.residual + prior.precision * (x - prior.centre)
        held = self.coordinates.bounds.pushed_out(x, gradient)
        rows = np.vstack([self.jacobian, np.diag(np.sqrt(prior.precision))])[:, ~held]
        wanted = np.append(self.residual, np.sqrt(prior.precision) * (x - prior.centre))
        followed = span_of(rows).T @ wanted
        return 0.5 * float(followed @ followed)

    @property
    def at_bound(self) -> tuple[NDArray[np.bool_], NDArray[np.bool_]]:
        """Which parameters ended at their lower, and which at their upper bound; each of shape (p,)."""
        return self.coordinates.bounds.reached(self.coordinates.of(self.parameters))


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Search coordinates: base parameters over their size, effects' as their priors have them (logarithms).

    Attributes
    ----------
    size : ndarray, shape (p,)
        Unit of each coordinate; 1 for effects.
    log : ndarray of bool, shape (p,)
    ends : (ndarray, ndarray)
        Lower and upper bounds of the parameters themselves.
    prior : NormalPrior
        Of the coordinates.
    """

    size: FloatArray
    log: NDArray[np.bool_]
    ends: tuple[FloatArray, FloatArray]
    prior: NormalPrior

    @classmethod
    def of_model(cls, model: CampaignModel) -> Coordinates:
        """Of a base law with its causes."""
        known, base = model.effect_parameters, model.base_count
        start = np.abs(model.law.start)
        size = np.append(np.where(start > 0.0, start, 1.0), np.ones(len(known)))
        log = np.array([False] * base + [parameter.log for parameter in known], dtype=bool)
        centre = np.append(np.zeros(base), [parameter.to_search(parameter.centre) for parameter in known])
        scale = np.append(model.base_scales / size[:base], [parameter.scale for parameter in known])
        return cls(size, log, model.bounds, NormalPrior(centre, 1.0 / scale**2))

    @cached_property
    def bounds(self) -> Bounds:
        """Of the coordinates."""
        return Bounds(*(self.of(end) for end in self.ends))

    def of(self, parameters: FloatArray) -> FloatArray:
        """Coordinates of parameters."""
        values = parameters / self.size
        with np.errstate(divide="ignore"):  # a bound at 0
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


class Reached(NamedTuple):
    """Where a refit came to, without its derivatives there: parameters (p,), and the steps that were taken."""

    parameters: FloatArray
    steps: int


def refit(
    problem: Problem,
    start: FloatArray | Refit,
    *,
    most_steps: int = MOST_STEPS,
    settled: float = SEARCH.settled,
    held: NDArray[np.bool_] | None = None,
) -> Refit:
    """Minimise |L r|^2 + prior from a start (`least_squares.minimise`).

    Parameters
    ----------
    problem : Problem
    start : ndarray, shape (p,), or Refit
        Where another one ended; of the same problem, its derivatives there are known.
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
    coordinates, minimum = _minimum(problem, start, most_steps, settled, held)
    return Refit(problem, coordinates.parameters(minimum.x), minimum.residual, minimum.jacobian)


def reached(
    problem: Problem, start: FloatArray | Refit, *, most_steps: int = MOST_STEPS, differentiable: bool = False
) -> Reached:
    """The same where only the parameters matter: the last step takes no derivatives, unless it is to end at some."""
    coordinates, minimum = _minimum(problem, start, most_steps, SEARCH.settled, None, differentiable)
    return Reached(coordinates.parameters(minimum.x), minimum.steps)


def _minimum(
    problem: Problem,
    start: FloatArray | Refit,
    most_steps: int,
    settled: float,
    held: NDArray[np.bool_] | None,
    tangent_at_end: bool = True,
) -> tuple[Coordinates, Minimum]:
    coordinates = Coordinates.of_model(problem.model)
    objective = SearchResidual(problem, coordinates)
    first = start.parameters if isinstance(start, Refit) else np.asarray(start, dtype=np.float64)
    first = np.clip(first, *coordinates.ends)
    tangent = _known_tangent(problem, start)
    return coordinates, minimise(
        objective,
        coordinates.of(first),
        tangent=objective.tangent_at(first) if tangent is None else tangent,
        bounds=coordinates.bounds,
        prior=coordinates.prior,
        held=held,
        settled=settled,
        damping=FIRST_DAMPING,
        most_steps=most_steps,
        tangent_at_end=tangent_at_end,
    )


def _known_tangent(problem: Problem, start: FloatArray | Refit) -> tuple[FloatArray, FloatArray] | None:
    """The residual and its derivatives where a search begins, if another one of the same problem ended there."""
    if not isinstance(start, Refit) or start.problem.model is not problem.model:
        return None
    same_noise = start.problem.whitener is problem.whitener and start.problem.moving is problem.moving
    return (start.residual, start.jacobian) if same_noise else None


@dataclass(frozen=True, eq=False)
class SearchResidual:
    """The residual of a problem along search coordinates, as `least_squares.minimise` takes it."""

    problem: Problem
    coordinates: Coordinates

    def residual(self, x: FloatArray) -> FloatArray:
        """Shape (N,)."""
        return self.problem.residual(self.coordinates.parameters(x))

    def tangent(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Residual (N,) and its derivatives along the coordinates (N, p)."""
        return self.tangent_at(self.coordinates.parameters(x))

    def tangent_at(self, parameters: FloatArray) -> tuple[FloatArray, FloatArray]:
        """The same at parameters."""
        residual, slopes = self.problem.residual_and_jacobian(parameters)
        return residual, slopes * self.coordinates.slopes(parameters)
