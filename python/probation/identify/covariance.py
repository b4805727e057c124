"""What is known about the estimates: covariance, identifiability, noise and bias of the fit residual."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import ndtri, stdtrit

from probation.inference.information import inverse_information
from probation.noise.whiteness import correlation_lags
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel


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

    def widened(self, factor: float) -> Covariance:
        """With standard errors so many times as large."""
        return replace(self, matrix=factor**2 * self.matrix, relative_error=factor * self.relative_error)

    def with_added(self, matrix: FloatArray, values: FloatArray) -> Covariance:
        """With an independent source of error on top, shape (free, free)."""
        total = self.matrix + matrix
        size = np.where(values != 0.0, np.abs(values), 1.0)
        relative = np.sqrt(np.maximum(np.diag(total), 0.0)) / size
        return replace(self, matrix=total, relative_error=np.where(np.isfinite(self.relative_error), relative, np.inf))


def covariance(
    jacobian: FloatArray,
    residual: FloatArray,
    lengths: Sequence[int],
    values: FloatArray,
    least_scatter: float = 0.0,
) -> Covariance:
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
    least_scatter : float
        Least variance that the whitened residual counts with: 1 where the noise allows for errors that need not be
        there.
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
    scatter = max(float(residual @ residual) / max(count - free, 1), least_scatter)
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


def noise_widening(noises: Sequence[NoiseModel]) -> float:
    """By how much standard errors widen because autocorrelated noise is only known as its estimate is.

    The variance v of the logarithm of its spectrum where it matters is that of a variance from 2 / v samples: the ratio
    of Student's quantiles for so many and for all of them.
    """
    if all(noise.correlation == 0.0 for noise in noises):
        return 1.0
    level = 1.0 / sum(1.0 / max(noise.level_variance, 1e-12) for noise in noises)
    variance = CERTIFICATE.slow_noise_share * max(noise.shape_variance for noise in noises) + level
    return float(stdtrit(2.0 / variance, 0.975) / ndtri(0.975)) if variance > 1e-6 else 1.0


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
