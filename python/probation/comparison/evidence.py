"""How probable a change is made by the data: Laplace's integral, with or without an unknown smooth change beside it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import log_ndtr, logsumexp

from probation.noise.smooth_basis import smooth_basis
from probation.noise.span import orthonormal
from probation.settings.comparison import COMPARISON

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.refit import Refit
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual

SIZES = 10.0 ** np.arange(0.5, 8.1, 0.5)
"""Squared sizes of an unknown change in units of the noise's variance per wave; log-uniform."""


@dataclass(frozen=True, eq=False)
class SmoothChange:
    """What an unknown change of one record may look like: whitened orthonormal waves and the spectrum along them.

    Attributes
    ----------
    columns : ndarray, shape (n, d)
    spectrum : ndarray, shape (d,)
        Sums to 1.
    """

    columns: FloatArray
    spectrum: FloatArray

    @classmethod
    def of(cls, record: RecordResidual, noise: NoiseModel) -> SmoothChange:
        """Of one record."""
        basis = smooth_basis(record.time, record.jumps, COMPARISON.roughest_change)
        columns, kept = orthonormal(noise.whiten(basis.columns))
        spectrum = (1.0 + basis.order[kept]) ** -COMPARISON.change_softness
        return cls(columns, spectrum / spectrum.sum())


@dataclass(frozen=True, eq=False)
class Tangent:
    """A change at its optimum, linearised.

    Attributes
    ----------
    residual : ndarray, shape (n,)
        Whitened.
    jacobian : ndarray, shape (n, p)
        Along the search coordinates.
    away, precision : ndarray, shape (p,)
        Coordinates minus the prior's centre; the prior's precision, 0 where it is flat.
    below, above : ndarray, shape (p,)
        Distances to the bounds.
    log_norm : float
        Log of the prior's density at its centre.
    """

    residual: FloatArray
    jacobian: FloatArray
    away: FloatArray
    precision: FloatArray
    below: FloatArray
    above: FloatArray
    log_norm: float

    @classmethod
    def nothing(cls, residual: FloatArray) -> Tangent:
        """No change."""
        empty = np.zeros(0)
        return cls(residual, np.zeros((len(residual), 0)), empty, empty, empty, empty, 0.0)

    @classmethod
    def of(cls, found: Refit) -> Tangent:
        """Of a refit."""
        coordinates = found.coordinates
        x = coordinates.of(found.parameters)
        away = x - coordinates.prior.centre
        log_norm = found.model.log_prior(found.parameters) + 0.5 * float(coordinates.prior.precision @ away**2)
        return cls(
            found.residual,
            found.jacobian,
            away,
            coordinates.prior.precision,
            x - coordinates.bounds.lower,
            coordinates.bounds.upper - x,
            log_norm,
        )

    def log_integral(self, smooth: SmoothChange | None = None, size: float = 0.0) -> float:
        """Log of the integral of likelihood times prior; with an unknown change of that squared size beside it."""
        residual, jacobian, total = self.residual, self.jacobian, 0.0
        if smooth is not None:
            variance = size * smooth.spectrum
            shrink = (1.0 - 1.0 / np.sqrt(1.0 + variance))[:, None] * smooth.columns.T
            residual = residual - smooth.columns @ (shrink @ residual)
            jacobian = jacobian - smooth.columns @ (shrink @ jacobian)
            total -= 0.5 * float(np.sum(np.log1p(variance)))
        total += self.log_norm - 0.5 * float(residual @ residual) - 0.5 * float(self.precision @ self.away**2)
        if not self.away.size:
            return total
        covariance = self._covariance(jacobian)
        pull = jacobian.T @ residual + self.precision * self.away
        step = -covariance @ pull
        deviation = np.sqrt(np.diag(covariance))
        inside = log_ndtr((self.above - step) / deviation) + log_ndtr((self.below + step) / deviation)
        total += 0.5 * float(pull @ covariance @ pull) + 0.5 * float(np.linalg.slogdet(covariance)[1])
        return total + 0.5 * len(step) * float(np.log(2.0 * np.pi)) + float(np.sum(inside))

    def log_integral_with_unknown(self, smooth: SmoothChange) -> float:
        """The same with an unknown change of any size beside it."""
        return float(logsumexp([self.log_integral(smooth, size) for size in SIZES])) - float(np.log(len(SIZES)))

    @property
    def covariance(self) -> FloatArray:
        """Of the search coordinates, shape (p, p)."""
        return self._covariance(self.jacobian)

    def _covariance(self, jacobian: FloatArray) -> FloatArray:
        normal = jacobian.T @ jacobian + np.diag(self.precision)
        size = np.sqrt(np.maximum(np.diag(normal), 1e-300))
        return np.asarray(np.linalg.pinv(normal / np.outer(size, size), hermitian=True) / np.outer(size, size))
