"""The force in a test whose frame is elastic: the force takes a part of the strain away from the specimen.

The recorded force would do as well were it not for its noise. With a large compliance that noise becomes a strain of
the specimen. The specimen is much stiffer than the frame, so it comes back as an error of the stress, many times the
noise, most of it at the onset. So the force is the model's own, y = G(y), G the stress that the law makes of what y
leaves to the specimen. Newton's method finds it from the recorded force, each step by generalised conjugate residuals
(Eisenstat, Elman & Schultz 1983) with the tangent's products from differences: any law will do. Each direction is what
a linear viscoelastic specimen would answer (`elastic_frame`), and gains about a digit; the cost is that of a dozen or
two of solves.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.errors import ConvergenceError

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray

MOST_NEWTON_STEPS = 12
"""Newton's steps; from a force that is recorded it takes two to four."""

MOST_DIRECTIONS = 24
"""Directions of one answer; it takes two to eight."""

MANY = 6
"""Directions of one step beyond which what is about right is read anew: it costs as much as six."""

MOST_KEPT = 72
"""Directions that answers at one force share: what an answer finds, the next one need not look for."""

PARTS = (1.0, 0.5, 0.25, 0.1, 0.03)
"""Parts of a step that are tried; the last is taken as it is."""

SETTLED = 1e-8
"""Step at which the force is found, and what a step may leave of what it is to remove; of the largest force."""

SLOPE = 1e-6
"""What the answer to a change of a parameter may leave of that change."""

ROUGHLY = 1e-3
"""The same where only the look of an effect counts, before it is refitted."""

GOOD_ENOUGH = 1e-5
"""What may be left at the end; beyond it there is no prediction: the start is a measurement."""

ROUGHEST, FINEST = 0.3, 1e-3
"""What a step that others follow may leave of what it is to remove: the first, and any of them (Eisenstat & Walker
1996, choice 2)."""

PATIENCE = 3
"""Steps in which half of what was left must go; more than a force that is found takes for it."""

HOPELESS = 400.0
"""About what the force would change by to follow what is left, of the largest force, beyond which no further step leads
back: of 1500 forces that were found it was never above 10, of 186 that were not found it was above this for half."""

LOST = 2
"""Steps in a row that all directions do not suffice for, after which none is followed: of 8400 forces that were sought
behind a soft frame and slack 120 went on like that, mostly for runaway parameters, at two thirds of the cost of all."""

PROBE = 1e-5
"""Change of the force over which the tangent is differenced, of the largest force."""


class OwnForce:
    """The fixed point y = G(y), and how it answers to what changes G.

    Parameters
    ----------
    stress : callable
        G: stress (n,) [MPa] from stress (n,) [MPa].
    start : ndarray, shape (n,) [MPa]
        The recorded stress, or something near it.
    about : callable, optional
        Of a stress (n,) about (I - dG/dy)^-1 there, which takes a direction (n,); the direction itself, if left out.
    settled : float
        `SETTLED` or `ROUGHLY`.

    Attributes
    ----------
    stress : ndarray, shape (n,) [MPa]
        The fixed point.
    kinks : tuple of int, or None
        Instants of kinks of the strain that G held while it was sought, where it held any.
    """

    kinks: tuple[int, ...] | None = None

    def __init__(
        self,
        stress: Callable[[FloatArray], FloatArray],
        start: FloatArray,
        about: Callable[[FloatArray], Callable[[FloatArray], FloatArray]] = lambda _: np.asarray,
        settled: float = SETTLED,
    ) -> None:
        self._of, self._about = stress, about(start)
        self.stress = start
        self._size = max(float(np.max(np.abs(start))), 1e-300)
        self._next = stress(start)
        self._directions, self._products = np.empty((2, MOST_KEPT, len(start)))
        self._known = 0
        with np.errstate(over="ignore", invalid="ignore"):  # far from any force that there is
            left = self._next - start
            norms, part_left = [float(np.linalg.norm(left))], ROUGHEST
        lost = 0
        for _ in range(MOST_NEWTON_STEPS):
            if np.max(np.abs(left)) <= settled * self._size:
                return
            stuck = len(norms) > PATIENCE and norms[-1] > 0.5 * norms[-1 - PATIENCE]
            if stuck or not np.max(np.abs(self._about(left))) < HOPELESS * self._size:
                break
            step = self.answer(left, part_left)
            directions = self._known
            # Where the law has a kink a whole step may overshoot.
            for part in PARTS:
                there = self.stress + part * step
                beyond = stress(there)
                with np.errstate(over="ignore", invalid="ignore"):  # too long a step
                    left = beyond - there
                    norm = float(np.linalg.norm(left))
                if norm < norms[-1]:
                    break
            self.stress, self._next, self._known = there, beyond, 0
            if directions > MANY and np.isfinite(norm):
                self._about = about(there)
            norms.append(norm)
            lost = lost + 1 if directions >= MOST_DIRECTIONS else 0
            if lost == LOST:
                break
            part_left = min(max((norm / norms[-2]) ** 2, FINEST), ROUGHEST)
        if not np.max(np.abs(left)) <= max(GOOD_ENOUGH, settled) * self._size:
            raise ConvergenceError("no force was found at which frame and specimen are in balance")

    def moved(self, stress: FloatArray) -> FloatArray:
        """What y becomes, to first order, where G gives this stress of the present y instead; (n,) [MPa]."""
        return self.stress + self.answer(stress - self._next, SLOPE)

    def answer(self, change: FloatArray, left: float = SETTLED) -> FloatArray:
        """How y changes where G changes by so much: (I - dG/dy)^-1 times it, but for a part `left`; (n,) [MPa]."""
        size = float(np.linalg.norm(change))
        if size == 0.0:
            return change
        if self._known > MOST_KEPT - MOST_DIRECTIONS:
            self._known = 0
        directions, products = self._directions, self._products
        along = products[: self._known] @ change
        solution, rest = along @ directions[: self._known], change - along @ products[: self._known]
        for k in range(self._known, self._known + MOST_DIRECTIONS):
            if np.linalg.norm(rest) <= left * size:
                break
            direction = self._about(rest)
            product = self._without_feedback(direction)
            for _ in range(2):  # Gram-Schmidt twice
                along = products[:k] @ product
                product = product - along @ products[:k]
                direction = direction - along @ directions[:k]
            length = float(np.linalg.norm(product))
            if not 0.0 < length < np.inf:  # nothing new, or beyond any force that there is
                break
            directions[k], products[k] = direction / length, product / length
            self._known = k + 1
            part = float(products[k] @ rest)
            solution, rest = solution + part * directions[k], rest - part * products[k]
        return solution

    def _without_feedback(self, direction: FloatArray) -> FloatArray:
        """(I - dG/dy) along a direction."""
        step = PROBE * self._size / max(float(np.max(np.abs(direction))), 1e-300)
        return np.asarray(direction - (self._of(self.stress + step * direction) - self._next) / step)
