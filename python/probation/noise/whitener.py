"""Residuals and Jacobians of several records in coordinates in which the noise is white."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.noise.spikes import without_spikes

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel


@dataclass(frozen=True, eq=False)
class Whitener:
    """L, record by record.

    Attributes
    ----------
    noises : tuple of NoiseModel
        In the order of the records.
    """

    noises: tuple[NoiseModel, ...]

    @property
    def slices(self) -> tuple[slice, ...]:
        """Rows of each record."""
        borders = np.cumsum([0, *(len(noise) for noise in self.noises)]).tolist()
        return tuple(slice(first, last) for first, last in pairwise(borders))

    def residual(self, residual: FloatArray) -> FloatArray:
        """L r of a stacked residual (N,), its outliers set aside."""
        parts = zip(self.noises, self.slices, strict=True)
        return np.concatenate([noise.whiten(without_spikes(residual[part], noise.spikes)) for noise, part in parts])

    def columns(self, matrix: FloatArray) -> FloatArray:
        """L times stacked columns (N, m)."""
        return np.vstack([noise.whiten(matrix[part]) for noise, part in zip(self.noises, self.slices, strict=True)])
