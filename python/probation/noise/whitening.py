"""All records in white coordinates, the base parameters projected out of them; draws of features under the null."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.noise.estimate import estimate_noise
from probation.noise.outliers import without_outliers
from probation.noise.span import span_of, without
from probation.noise.whitener import Whitener

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.noise.uncertain_scatter import UncertainScatter


@dataclass(frozen=True, eq=False)
class Whitened:
    """L r and the tangent's span Q over all records; P = I - Q Q^T.

    Attributes
    ----------
    records : tuple of RecordResidual
    noises : tuple of NoiseModel
    slices : tuple of slice
        Rows of each record.
    residual : ndarray, shape (N,)
        z = P L r: whitened, refitted.
    span : ndarray, shape (N, p)
        Orthonormal basis of the whitened base tangent, jointly over the records.
    """

    records: tuple[RecordResidual, ...]
    noises: tuple[NoiseModel, ...]
    slices: tuple[slice, ...]
    residual: FloatArray
    span: FloatArray

    @classmethod
    def of(cls, records: Sequence[RecordResidual], noises: Sequence[NoiseModel] | None = None) -> Whitened:
        """Whiten the records; the noise is estimated where none is given.

        Parameters
        ----------
        records : sequence of RecordResidual
            At one base fit, whose parameters they share.
        noises : sequence of NoiseModel, optional
        """
        whitener = Whitener(tuple(noises) if noises is not None else estimate_noise(records))
        residual = whitener.residual(np.concatenate([record.residual for record in records]))
        span = span_of(whitener.columns(np.vstack([record.tangent for record in records])))
        return cls(tuple(records), whitener.noises, whitener.slices, without(residual, span), span)

    def with_residual(self, residual: FloatArray, jacobian: FloatArray) -> Whitened:
        """The same records at another fit: its whitened residual (N,) and Jacobian (N, p), projected."""
        span = span_of(jacobian)
        return replace(self, residual=without(residual, span), span=span)

    def __len__(self) -> int:
        return len(self.residual)

    def clean(self, index: int) -> FloatArray:
        """A record's residual without its outliers, shape (n_r,) [MPa]."""
        return without_outliers(self.records[index].residual, self.noises[index].outliers)

    def whiten(self, blocks: Sequence[FloatArray]) -> FloatArray:
        """One (n_r, m) block per record, all of the same m, whitened and stacked: shape (N, m)."""
        return Whitener(self.noises).columns(np.vstack(blocks))

    def project(self, matrix: FloatArray) -> FloatArray:
        """P times whitened columns: what a refit of the base parameters leaves of them."""
        return without(matrix, self.span)

    def alone(self, index: int) -> Whitened:
        """One record with the base parameters refitted to it alone."""
        return Whitened.of([self.records[index]], [self.noises[index]])

    def scales(self, rng: np.random.Generator, size: int) -> FloatArray:
        """Draws of true over estimated standard deviation at low frequency, shape (size, n_records)."""
        shape = max((noise.shape_variance for noise in self.noises), default=0.0)
        level = np.array([noise.level_variance for noise in self.noises])
        logs = np.sqrt(shape) * rng.standard_normal((size, 1))
        logs = logs + np.sqrt(level) * rng.standard_normal((size, len(level)))
        return np.asarray(np.exp(0.5 * logs), dtype=np.float64)

    @property
    def scale_spread(self) -> float:
        """Standard deviation of the logarithm of that scale, the records' mean."""
        level = float(np.mean([noise.level_variance for noise in self.noises]))
        shape = max((noise.shape_variance for noise in self.noises), default=0.0)
        return 0.5 * float(np.sqrt(shape + level))

    def reduced(self, columns: FloatArray) -> Reduced:
        """The few coordinates per record that carry `columns` (N, m, whitened) and the refit of the base parameters."""
        both = np.hstack([columns, self.span])
        frames = []
        for part in self.slices:
            own = both[part]
            size = np.linalg.norm(own, axis=0)
            used = size > 0.0
            frames.append(np.linalg.qr(own[:, used] / size[used])[0] if used.any() else np.zeros((len(own), 0)))
        return Reduced(self, tuple(frames))

    def local_draws(self, features: Sequence[FloatArray], rng: np.random.Generator, size: int) -> list[FloatArray]:
        """Draws of P-projected local features' products with z: per record an array (size, m_r).

        Parameters
        ----------
        features : sequence of ndarray, shape (n_r, m_r)
            Whitened columns that live in one record each; the refit, which couples the records, is in the draws.
        """
        scales = self.scales(rng, size)
        own, along = [], np.zeros((size, self.span.shape[1]))
        for index, part in enumerate(self.slices):
            width = features[index].shape[1]
            both = np.hstack([features[index], self.span[part]])
            drawn = scales[:, index, None] * _gaussian(both, rng, size)
            own.append(drawn[:, :width])
            along += drawn[:, width:]
        return [
            drawn - along @ (self.span[part].T @ feature)
            for drawn, part, feature in zip(own, self.slices, features, strict=True)
        ]


@dataclass(frozen=True, eq=False)
class Reduced:
    """Whitened records seen through an orthonormal frame each.

    White noise stays white in it, so that a parametric bootstrap with (linearised) refit, which would draw every
    sample's noise, whiten it with the *estimated* level and project it, draws a few numbers per record instead: the
    distribution of everything that lies in the frames is the same.

    Attributes
    ----------
    whitened : Whitened
    frames : tuple of ndarray, shape (n_r, k_r)
    """

    whitened: Whitened
    frames: tuple[FloatArray, ...]

    def of(self, columns: FloatArray) -> FloatArray:
        """Whitened columns (N,) or (N, m) in the frames, stacked."""
        parts = zip(self.frames, self.whitened.slices, strict=True)
        return np.concatenate([frame.T @ columns[part] for frame, part in parts])

    def draws(
        self, features: FloatArray, rng: np.random.Generator, size: int, scatter: UncertainScatter | None = None
    ) -> FloatArray:
        """Draws of features^T z under "no gap", shape (size, m), for reduced *and projected* features."""
        scales = self.whitened.scales(rng, size)
        borders = np.cumsum([0, *(frame.shape[1] for frame in self.frames)])
        noise = rng.standard_normal((size, borders[-1]))
        for own, (first, stop) in zip(scales.T, pairwise(borders), strict=True):
            noise[:, first:stop] *= own[:, None]
        if scatter is not None:
            noise = scatter.spread(noise, rng, self.of)
        return np.asarray(noise @ features, dtype=np.float64)


def _gaussian(columns: FloatArray, rng: np.random.Generator, size: int) -> FloatArray:
    """Draws of columns^T e with e standard normal: N(0, columns^T columns)."""
    values, vectors = np.linalg.eigh(columns.T @ columns)
    keep = values > 1e-12 * max(float(values[-1]), 1e-300) if values.size else values > 0.0
    root = vectors[:, keep] * np.sqrt(values[keep])
    return np.asarray(rng.standard_normal((size, root.shape[1])) @ root.T, dtype=np.float64)
