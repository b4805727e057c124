"""AR(1) noise: found in a fit residual by restricted maximum likelihood, and distinguished from a model's bias."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize_scalar
from scipy.special import chdtrc

from probation.identify.covariance import correlation_lags
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.ar1 import NoiseModel


LAGS = 20
"""That this test looks at, and a tenth of the samples at most."""


WORTH_A_LOOK = 2.0
"""Correlation of neighbours [1 / sqrt(samples)] below which the gain cannot be significant."""

SHORTEST = 30
"""Samples of a record below which no correlation is looked for."""


def fitted_noise(
    noise: NoiseModel, residual: FloatArray, jacobian: FloatArray, *, differenced: bool
) -> tuple[NoiseModel, float]:
    """The noise model with the AR(1) correlation of the residual, and all of it scaled to the residual.

    The correlation stays 0 where it is not significant, and where AR(1) noise would not look like this residual: then
    it is a bias, for which the covariance of the estimate has its own remedy.

    Parameters
    ----------
    noise : NoiseModel
        White, with or without propagated strain noise.
    residual : ndarray, shape (n_times,) [MPa]
    jacobian : ndarray, shape (n_times, free)
        What the fit has taken out of the residual.
    differenced : bool
        Whether the scale was estimated from differences of neighbours, which see less of correlated noise.

    Returns
    -------
    noise : NoiseModel
    factor : float
        By which all its noise was scaled.
    """
    left = noise.whiten(residual)
    if not left.any():
        return noise, 1.0
    neighbours = float(left[1:] @ left[:-1]) / float(left @ left)
    if len(residual) >= SHORTEST and neighbours > WORTH_A_LOOK / np.sqrt(len(left)):

        def correlated(correlation: float) -> NoiseModel:
            seen = 1.5 - 2.0 * correlation + 0.5 * correlation**2  # variance of the distance to the neighbours' mean
            scale = noise.scale * float(np.sqrt(1.5 / seen)) if differenced else noise.scale
            return replace(noise, scale=scale, correlation=correlation)

        found = minimize_scalar(
            lambda correlation: _criterion(correlated(correlation), residual, jacobian),
            bounds=(1e-3, CERTIFICATE.strongest_correlation),
            method="bounded",
            options={"xatol": 1e-3},
        )
        candidate = correlated(float(found.x))
        gain = _criterion(noise, residual, jacobian) - float(found.fun)
        if (
            gain > CERTIFICATE.correlation_gain
            and found.x < 0.99 * CERTIFICATE.strongest_correlation
            and _white(candidate.whiten(residual))
        ):
            noise = candidate
            left = noise.whiten(residual)
    freedom = max(len(residual) - jacobian.shape[1], 1)
    factor = float(np.sqrt(left @ left / freedom))
    return noise.scaled(factor), factor


def _white(innovation: FloatArray) -> bool:
    """Whether innovations are white, in the long run and by Ljung and Box's test."""
    count, lags = len(innovation), min(LAGS, len(innovation) // 10)
    centred = innovation - innovation.mean()
    variance = float(centred @ centred)
    statistic = sum((float(centred[k:] @ centred[:-k]) / variance) ** 2 / (count - k) for k in range(1, lags + 1))
    chance = float(chdtrc(lags - 1, count * (count + 2.0) * statistic))
    return chance > CERTIFICATE.white_enough and correlation_lags(innovation) == 0


def _criterion(noise: NoiseModel, residual: FloatArray, jacobian: FloatArray) -> float:
    """Minus twice the restricted log-likelihood, the scale of all noise profiled out (Harville 1977)."""
    size = np.linalg.norm(jacobian, axis=0)
    columns = noise.whiten(np.column_stack([jacobian / np.where(size > 0.0, size, 1.0), residual]))
    triangle = np.abs(np.diag(np.linalg.qr(columns, mode="r")))
    free = jacobian.shape[1]
    within = 2.0 * float(np.log(np.maximum(triangle[:free], 1e-300)).sum())
    return float(
        2.0 * (len(residual) - free) * float(np.log(max(triangle[free], 1e-300)))
        + noise.log_determinant
        + within
        + 2.0 * len(residual) * float(np.log(noise.scale))
    )
