"""What is known about the estimates: covariance, identifiability, noise and bias of the fit residual."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.information import inverse_information
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


@dataclass(frozen=True)
class Covariance:
    """Covariance of the identified parameters.

    Attributes
    ----------
    matrix : ndarray, shape (free, free)
    relative_error : ndarray, shape (free,)
        Standard error over value; inf where the data do not determine the parameter.
    condition_number : float
        Of the Jacobian whose columns are scaled by the parameters.
    correlated : bool
        Whether the fit residual is autocorrelated, which widens the errors.
    """

    matrix: FloatArray
    relative_error: FloatArray
    condition_number: float
    correlated: bool

    def standard_error(self, index: int) -> float | None:
        """Of one parameter; None where the data do not determine it."""
        if not np.isfinite(self.relative_error[index]):
            return None
        return float(np.sqrt(self.matrix[index, index]))

    def with_added(self, matrix: FloatArray, values: FloatArray) -> Covariance:
        """With an independent source of error on top, shape (free, free)."""
        total = self.matrix + matrix
        size = np.where(values != 0.0, np.abs(values), 1.0)
        relative = np.sqrt(np.maximum(np.diag(total), 0.0)) / size
        return replace(self, matrix=total, relative_error=np.where(np.isfinite(self.relative_error), relative, np.inf))


def covariance(jacobian: FloatArray, residual: FloatArray, lengths: Sequence[int], values: FloatArray) -> Covariance:
    """Covariance of a least-squares estimate with whitened residual, from the scaled Jacobian's singular values.

    White fit residuals give s^2 (J^T J)^-1. Correlated ones (the low-frequency bias of a law, or filtered noise) give
    the sandwich (J^T J)^-1 S (J^T J)^-1, S the long-run covariance of the scores (Newey & West 1987), summed over
    records.

    Parameters
    ----------
    jacobian : ndarray, shape (n_samples, free)
        Of the whitened fit residual.
    residual : ndarray, shape (n_samples,)
    lengths : sequence of int
        Samples of each record.
    values : ndarray, shape (free,)
        The estimates.
    """
    count, free = jacobian.shape
    if free == 0:
        return Covariance(np.zeros((0, 0)), np.zeros(0), 1.0, False)
    size = np.where(values != 0.0, np.abs(values), 1.0)
    scaled = jacobian * size
    inverse, lost, condition = inverse_information(scaled)

    borders = np.concatenate([[0], np.cumsum(lengths)])
    parts = [slice(first, last) for first, last in pairwise(borders.tolist())]
    bandwidths = [correlation_lags(residual[part]) for part in parts]
    correlated = any(bandwidth > 0 for bandwidth in bandwidths)
    scatter = float(residual @ residual) / max(count - free, 1)
    relative = scatter * inverse
    if correlated:
        middle = np.zeros((free, free))
        for part, bandwidth in zip(parts, bandwidths, strict=True):
            middle += _long_run(scaled[part] * residual[part, None], bandwidth)
        sandwich = inverse @ middle @ inverse * count / max(count - free, 1)
        # Never narrower than the white one: a long wave seen once looks like no variance at all to the sandwich.
        keep = np.diag(sandwich) < np.diag(relative)
        scale = np.where(keep, np.sqrt(np.diag(relative) / np.maximum(np.diag(sandwich), 1e-300)), 1.0)
        relative = sandwich * np.outer(scale, scale)
    error = np.where(lost, np.inf, np.sqrt(np.maximum(np.diag(relative), 0.0)))
    return Covariance(relative * np.outer(size, size), error, condition, correlated)


def correlation_lags(residual: FloatArray) -> int:
    """Lags over which a residual is correlated: 0 for a white one, else four times its correlation length."""
    inflation = mean_inflation(residual)
    return 0 if inflation < CERTIFICATE.white_ratio else min(max(int(4.0 * inflation), 1), len(residual) // 2)


def mean_inflation(residual: FloatArray) -> float:
    """How many times the variance of a residual's mean is that of as many independent samples; 1 if it is white."""
    count = len(residual)
    centred = residual - residual.mean()
    variance = float(centred @ centred) / count
    if variance == 0.0 or count < 20:
        return 1.0
    spectrum = np.abs(np.fft.rfft(centred, 2 * count)) ** 2
    autocovariance = np.fft.irfft(spectrum)[: count // 2] / count / variance
    # Sum up to the first lag that is not above chance (Sokal's window would need one more choice).
    chance = 2.0 / np.sqrt(count)
    below = np.flatnonzero(autocovariance[1:] < chance)
    last = int(below[0]) if below.size else len(autocovariance) - 1
    return 1.0 + 2.0 * float(autocovariance[1 : last + 1].sum())


def _long_run(scores: FloatArray, bandwidth: int) -> FloatArray:
    """Long-run covariance of the scores, Bartlett weights; all lags at once by Fourier transform."""
    count = len(scores)
    spectrum = np.fft.rfft(scores, 2 * count, axis=0)
    # lagged[k, a, b] = sum over i of scores[i, a] scores[i + k, b]
    lagged = np.fft.irfft(spectrum.conj()[:, :, None] * spectrum[:, None, :], 2 * count, axis=0)
    lags = np.arange(1, bandwidth + 1)
    weights = 1.0 - lags / (bandwidth + 1.0)
    cross = np.tensordot(weights, lagged[lags], axes=1)
    return np.asarray(lagged[0] + cross + cross.T, dtype=np.float64)
