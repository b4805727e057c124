"""AR(1) noise of a fit residual, with strain noise propagated to the stress."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky, solve_triangular

if TYPE_CHECKING:
    from probation._arrays import FloatArray

NEGLIGIBLE_VARIANCE = 1e-12
"""Carried noise of a smaller variance than this, in units of the stress noise's, is none."""


@dataclass(frozen=True, eq=False)
class NoiseModel:
    r"""Covariance of a fit residual, :math:`\Sigma = s^2 R(\rho) + C C^T`, and how to whiten with it.

    Attributes
    ----------
    scale : float
        Standard deviation s of the stress noise [MPa].
    correlation : float
        :math:`\rho` of AR(1) stress noise at the record's median time step, 0 to 1; 0 is white noise.
    time_step : ndarray, shape (n_times - 1,)
        Over their median [-]: from sample to sample the correlation is rho to that power.
    carried : ndarray, shape (n_times, n_directions), or None
        C, the stress that independent unit errors of the strain make [MPa]; C C^T is sigma_x^2 D D^T.
    """

    scale: float
    correlation: float
    time_step: FloatArray
    carried: FloatArray | None = None

    @classmethod
    def white(cls, scale: float, time: FloatArray) -> NoiseModel:
        """White noise of one standard deviation [MPa] at those times [s]."""
        step = np.diff(time)
        return cls(scale, 0.0, step / np.median(step))

    def with_carried(self, carried: FloatArray | None) -> NoiseModel:
        """The same with other propagated strain noise, shape (n_times, n_directions) [MPa]."""
        return replace(self, carried=carried)

    def scaled(self, factor: float) -> NoiseModel:
        """All noise, of stress and strain, `factor` times as large."""
        carried = None if self.carried is None else factor * self.carried
        return replace(self, scale=factor * self.scale, carried=carried)

    def whiten(self, values: FloatArray) -> FloatArray:
        """W `values` with W^T W = Sigma^-1, samples along axis 0, in their order; shape as given."""
        filtered = self._filter(values)
        if self.carried is None:
            return filtered
        return self._root.whiten(filtered)

    def solve(self, values: FloatArray) -> FloatArray:
        """Sigma^-1 `values`, shape (n_times,)."""
        whitened = self.whiten(values)
        if self.carried is not None:
            whitened = self._root.whiten_transposed(whitened)
        inverse, weight = self._ar1
        found = inverse * whitened
        found[:-1] -= weight * whitened[1:]
        return found / self.scale

    @cached_property
    def log_determinant(self) -> float:
        """Of Sigma over the scale's square, log [-]."""
        ar1 = -2.0 * float(np.log(self._ar1[0]).sum())
        return ar1 + (0.0 if self.carried is None else self._root.log_determinant)

    @cached_property
    def _ar1(self) -> tuple[FloatArray, FloatArray]:
        """Innovation = inverse * value - weight * value before; shapes (n_times,), (n_times - 1,)."""
        if self.correlation == 0.0:
            return np.ones(len(self.time_step) + 1), np.zeros(len(self.time_step))
        step = self.correlation**self.time_step
        inverse = np.append(1.0, 1.0 / np.sqrt(-np.expm1(2.0 * np.log(self.correlation) * self.time_step)))
        return inverse, step * inverse[1:]

    def _filter(self, values: FloatArray) -> FloatArray:
        if self.correlation == 0.0:
            return values / self.scale
        inverse, weight = self._ar1
        if values.ndim > 1:
            inverse, weight = inverse[:, None], weight[:, None]
        found = inverse * values
        found[1:] -= weight * values[:-1]
        return found / self.scale

    @cached_property
    def _root(self) -> _Full | _Low:
        assert self.carried is not None
        carried = self._filter(self.carried)
        return _Low(carried) if 3 * carried.shape[1] < carried.shape[0] else _Full(carried)


class _Full:
    """(1 + U U^T)^-1/2 by Cholesky's factor: U has about as many columns as rows."""

    def __init__(self, carried: FloatArray) -> None:
        matrix = carried @ carried.T
        matrix[np.diag_indices_from(matrix)] += 1.0
        self.factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
        self.log_determinant = 2.0 * float(np.log(np.diag(self.factor)).sum())

    def whiten(self, values: FloatArray) -> FloatArray:
        found: FloatArray = solve_triangular(self.factor, values, lower=True, check_finite=False)
        return found

    def whiten_transposed(self, values: FloatArray) -> FloatArray:
        found: FloatArray = solve_triangular(self.factor, values, lower=True, trans="T", check_finite=False)
        return found


class _Low:
    """(1 + U U^T)^-1/2, symmetric, by the few directions that U spans."""

    def __init__(self, carried: FloatArray) -> None:
        variance, basis = np.linalg.eigh(carried.T @ carried)
        kept = variance > NEGLIGIBLE_VARIANCE
        self.directions = carried @ basis[:, kept] / np.sqrt(variance[kept])
        self.shrink = 1.0 - 1.0 / np.sqrt(1.0 + variance[kept])
        self.log_determinant = float(np.log1p(variance[kept]).sum())

    def whiten(self, values: FloatArray) -> FloatArray:
        along = self.directions.T @ values
        shrink = self.shrink if values.ndim == 1 else self.shrink[:, None]
        found: FloatArray = values - self.directions @ (shrink * along)
        return found

    whiten_transposed = whiten
