"""Where a search for causes begins: every effect, form and placement at its best start, ranked by its score."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation.inference.screen import Screen
from probation.noise.span import span_of, without
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.cause import Cause
    from probation.effects.effect import Effect, Form
    from probation.inference.model import CampaignModel
    from probation.inference.screen import Column, Onset
    from probation.noise.whitener import Whitener

Key: TypeAlias = "tuple[str, str, tuple[str, ...] | None]"


@dataclass(frozen=True, eq=False)
class Candidate:
    """A cause and where its search begins.

    Attributes
    ----------
    cause : Cause
    values : tuple of float
        Of its parameters: the amplitude that the linearised model wants, and the nonlinear parameters.
    gain : float
        By how much the linearised objective falls.
    base : ndarray, shape (n_base,), optional
        The law's parameters where it was found; those of the fit that is extended, if left out.
    """

    cause: Cause
    values: tuple[float, ...]
    gain: float
    base: FloatArray | None = None


@dataclass(frozen=True, eq=False)
class WhitenedColumns:
    """Columns of a screen in white coordinates, unprojected.

    Attributes
    ----------
    columns : sequence of Column
    matrix : ndarray, shape (N, n_columns)
    """

    columns: Sequence[Column]
    matrix: FloatArray

    @classmethod
    def of(cls, columns: Sequence[Column], whitener: Whitener, count: int) -> WhitenedColumns:
        """Whiten a screen's columns; `count` is the number of stacked samples."""
        matrix = np.zeros((count, len(columns)), order="F")
        for index, column in enumerate(columns):
            matrix[column.rows, index] = column.slope
        return cls(columns, whitener.columns(matrix))

    @classmethod
    def of_smooth(cls, columns: Sequence[Column], whitener: Whitener, count: int) -> WhitenedColumns:
        """The same of those that are not sharp: lines and steps have tests of their own."""
        return cls.of([column for column in columns if column.cause.form.sharp is None], whitener, count)

    def by_effect(self) -> dict[str, FloatArray]:
        """The columns of every effect."""
        places: dict[str, list[int]] = {}
        for index, column in enumerate(self.columns):
            places.setdefault(column.cause.effect.name, []).append(index)
        return {name: self.matrix[:, own] for name, own in places.items()}

    def candidates(self, residual: FloatArray, span: FloatArray) -> list[Candidate]:
        """Every cause at its best starts, best first; the second-best of a cause comes further down.

        Parameters
        ----------
        residual : ndarray, shape (N,)
            Whitened.
        span : ndarray, shape (N, p)
            Orthonormal basis of what a refit of the present model may change.
        """
        along = self.matrix.T @ without(residual, span)
        square = np.einsum("ij,ij->j", self.matrix, self.matrix) - np.sum((span.T @ self.matrix) ** 2, axis=0)
        return _ranked(self.columns, along, square)


@dataclass(frozen=True, eq=False)
class Extended:
    """A model to which causes are to be added, at its parameters.

    Attributes
    ----------
    model : CampaignModel
    parameters : ndarray, shape (n_parameters,)
    effects, unsolved, only
        As in `Screen.of`; starts are read from the model's own residual.
    whitener : Whitener
    residual : ndarray, shape (N,)
        Whitened.
    jacobian : ndarray, shape (N, p)
        Whitened: what a refit of the model may change.
    """

    model: CampaignModel
    parameters: FloatArray
    effects: Sequence[Effect]
    whitener: Whitener
    residual: FloatArray
    jacobian: FloatArray
    unsolved: Callable[[Cause, Exception], None] | None = None
    only: Callable[[Form], bool] | None = None

    @cached_property
    def span(self) -> FloatArray:
        """Orthonormal basis of what a refit of the model may change, shape (N, k)."""
        return span_of(self.jacobian)

    @cached_property
    def directions(self) -> FloatArray:
        """What slopes are multiplied by in white coordinates, shape (N, m): what adds up over the records."""
        wanted = np.column_stack([without(self.residual, self.span), self.span])
        return np.hstack([self.whitener.between_records(wanted), self.whitener.shared[0]])

    def screen(self) -> Screen:
        """The causes that may be added."""
        return Screen.of(
            self.model,
            self.effects,
            residual=self.model.residual(self.parameters),
            unsolved=self.unsolved,
            only=self.only,
        )

    def candidates(self, found: Sequence[Onset]) -> list[Candidate]:
        """Every cause at its best starts, best first."""
        if not found:
            return []
        noted_of = np.stack([np.sum(onset.parts, axis=0) for onset in found], axis=1)
        square, along = noted_of[:2]
        followed, common = np.split(noted_of[2:], [self.span.shape[1]])
        square = square + np.sum(common * (self.whitener.shared[1] @ common), axis=0) - np.sum(followed**2, axis=0)
        return _ranked(found, along, square)


def noted(whitener: Whitener, index: int, directions: FloatArray, slopes: FloatArray) -> FloatArray:
    """Squares of slopes along a record, and their products with its directions, shape (1 + m, n_slopes)."""
    white = whitener.of_record(index, slopes)
    return np.vstack([np.einsum("ij,ij->j", white, white), directions.T @ white])


def for_a_test(form: Form) -> bool:
    """All but variants: more directions would be found in more noise."""
    return not form.variant


def _ranked(columns: Sequence[Column | Onset], along: FloatArray, square: FloatArray) -> list[Candidate]:
    """Candidates by what they gain, from products with the residual and squares, after the model's own refit."""
    candidates = []
    for column, slope, size in zip(columns, along.tolist(), square.tolist(), strict=True):
        amplitude = column.cause.form.amplitude
        wanted = -slope / max(size + amplitude.scale**-2.0, 1e-300)
        wanted = min(max(wanted, amplitude.lower), amplitude.upper)
        gain = -(2.0 * wanted * slope + wanted**2 * size)
        if column.cause.form.threshold:
            start = column.values[0]
        else:
            largest = SEARCH.largest_start * amplitude.scale if np.isfinite(amplitude.scale) else amplitude.upper
            start = min(max(wanted, -largest), largest)
        candidates.append(Candidate(column.cause, (start, *column.values[1:]), gain))
    return sorted(candidates, key=lambda candidate: -candidate.gain)


def cause_key(cause: Cause) -> Key:
    """Names of a cause's effect and form, and its records."""
    return cause.effect.name, cause.form.name, cause.records
