"""Whether a series is white: in the long run, and by Ljung and Box's test."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.settings.certificate import CERTIFICATE
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def correlation_lags(residual: FloatArray) -> int:
    """Lags over which a residual is correlated: 0 for a white one, else four times its correlation length."""
    inflation = mean_inflation(residual)
    return (
        0
        if inflation < CERTIFICATE.white_ratio
        else min(max(int(NOISE.correlation_lengths * inflation), 1), len(residual) // 2)
    )


def mean_inflation(residual: FloatArray) -> float:
    """How many times the variance of a residual's mean is that of as many independent samples; 1 if it is white."""
    count = len(residual)
    centred = residual - residual.mean()
    variance = float(centred @ centred) / count
    if variance == 0.0 or count < NOISE.fewest_for_inflation:
        return 1.0
    spectrum = np.abs(np.fft.rfft(centred, 2 * count)) ** 2
    autocovariance = np.fft.irfft(spectrum)[: count // 2] / count / variance
    # Sum up to the first lag that is not above chance (Sokal's window would need one more choice).
    chance = 2.0 / np.sqrt(count)
    below = np.flatnonzero(autocovariance[1:] < chance)
    last = int(below[0]) if below.size else len(autocovariance) - 1
    return 1.0 + 2.0 * float(autocovariance[1 : last + 1].sum())


def is_white(innovation: FloatArray) -> bool:
    """Whether innovations (n,) are white, in the long run and by Ljung and Box's test."""
    count, lags = len(innovation), min(NOISE.tested_lags, len(innovation) // 10)
    centred = innovation - innovation.mean()
    variance = float(centred @ centred)
    if correlation_lags(innovation) > 0:
        return False
    if variance == 0.0 or lags < 2:
        return True
    statistic = sum((float(centred[k:] @ centred[:-k]) / variance) ** 2 / (count - k) for k in range(1, lags + 1))
    return float(chdtrc(lags - 1, count * (count + 2.0) * statistic)) > CERTIFICATE.white_enough
