"""Residuals and Jacobians of several records in coordinates in which the noise is white."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.noise.outliers import without_outliers
from probation.noise.own_deviations import specimens_of

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel

LEAST_SHARED = 1e-12
"""Smallest variance, over the noise's, of what records of one specimen do not share: rounding."""


@dataclass(frozen=True, eq=False)
class Whitener:
    """L, record by record; then what records of one specimen have in common.

    Attributes
    ----------
    noises : tuple of NoiseModel
        In the order of the records.
    """

    noises: tuple[NoiseModel, ...]

    @cached_property
    def slices(self) -> tuple[slice, ...]:
        """Rows of each record."""
        borders = np.cumsum([0, *(len(noise) for noise in self.noises)]).tolist()
        return tuple(slice(first, last) for first, last in pairwise(borders))

    def residual(self, residual: FloatArray) -> FloatArray:
        """L r of a stacked residual (N,), its outliers set aside."""
        own = [self.of_record(index, residual[part]) for index, part in enumerate(self.slices)]
        return self.between_records(np.concatenate(own))

    def columns(self, matrix: FloatArray) -> FloatArray:
        """L times stacked columns (N, m), the outliers of the residual set aside in them, too."""
        white = np.empty_like(matrix)
        for index, part in enumerate(self.slices):
            block = matrix[part]
            seen = block[-1] != 0.0  # what acts in one record is nothing in the others
            if not seen.all():  # mostly the last sample says so, in an eighth of the time
                seen = block.any(axis=0)
            if seen.all():
                white[part] = self.of_record(index, block)
            else:
                white[part, ~seen] = 0.0
                if seen.any():
                    white[part, seen] = self.of_record(index, block[:, seen])
        return self.between_records(white)

    def of_record(self, index: int, values: FloatArray) -> FloatArray:
        """One record's part of stacked columns (n,) or (n, m), white by itself."""
        noise = self.noises[index]
        return noise.whiten(without_outliers(values, noise.outliers))

    def between_records(self, values: FloatArray) -> FloatArray:
        """Columns (N,) or (N, m), each record white by itself, in coordinates in which all are white together.

        A symmetric matrix times the columns, which it changes.
        """
        for rows, basis, root in self._of_specimens:
            own = values[rows]
            values[rows] = own + basis @ (root @ (basis.T @ own))
        return values

    @cached_property
    def shared(self) -> tuple[FloatArray, FloatArray]:
        """Q (N, k), orthonormal, and B (k, k): what is white record by record has a square of 1 + Q B Q^T in all."""
        widths = [root.shape[0] for _, _, root in self._of_specimens]
        directions = np.zeros((self.slices[-1].stop, sum(widths)))
        more = np.zeros((sum(widths), sum(widths)))
        at = 0
        for (rows, basis, root), width in zip(self._of_specimens, widths, strict=True):
            own = slice(at, at + width)
            directions[rows, own] = basis
            more[own, own] = 2.0 * root + root @ root
            at += width
        return directions, more

    @cached_property
    def _of_specimens(self) -> list[tuple[FloatArray, FloatArray, FloatArray]]:
        """Of each specimen with several records its rows, a basis Q of them, and M: (I + S)^(-1/2) = I + Q M Q^T.

        S is the covariance from record to record; that within a record is white already.
        """
        by_specimen = []
        for group in specimens_of(self.noises):
            if len(group) < 2:
                continue
            blocks, seen = [], []
            for index in group:
                columns = self.noises[index].specimen
                if columns is None or not columns.shape[1]:
                    continue
                left, size, right = np.linalg.svd(self.noises[index].whiten(columns), full_matrices=False)
                blocks.append(left)
                seen.append(size[:, None] * right)
            if not blocks:
                continue
            rows = np.concatenate([np.arange(len(self.noises[index])) + self.slices[index].start for index in group])
            widths = [block.shape[1] for block in blocks]
            basis = np.zeros((len(rows), sum(widths)))
            shared = np.vstack(seen) @ np.vstack(seen).T
            row = at = 0
            for block, width in zip(blocks, widths, strict=True):
                basis[row : row + len(block), at : at + width] = block
                shared[at : at + width, at : at + width] = np.eye(width)
                row, at = row + len(block), at + width
            values, vectors = np.linalg.eigh(shared)
            root = (vectors / np.sqrt(np.maximum(values, LEAST_SHARED))) @ vectors.T
            by_specimen.append((rows, basis, root - np.eye(len(root))))
        return by_specimen
