"""Noise that comes in bursts: its size along a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import binary_dilation, median_filter, uniform_filter1d

from probation.records.runs import runs
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray

MEDIAN_OF_NORMAL = 0.6745
"""Median of the modulus of a standard normal variable."""


def local_size(noise: FloatArray) -> FloatArray | None:
    """Size of the noise at every sample over its usual one, (n,); None where it is the same all along.

    Parameters
    ----------
    noise : ndarray, shape (n,)
        What no smooth curve takes, over its growth.
    """
    rough = np.abs(np.convolve(noise, [1.0, -2.0, 1.0], mode="same"))
    followed = _followed(noise)
    bursts = _bursts(rough)
    return bursts if followed is None else followed


def _bursts(rough: FloatArray) -> FloatArray | None:
    """By medians over short windows: half of a window has to be in the burst."""
    typical = float(np.median(rough))
    if len(rough) < 4 * NOISE.shortest_burst or typical == 0.0:
        return None
    ratio = np.maximum(median_filter(rough, NOISE.shortest_burst, mode="nearest") / typical, 1e-3)
    scatter = float(np.median(np.abs(np.log(ratio)))) / MEDIAN_OF_NORMAL
    least = max(NOISE.burst_ratio, float(np.exp(NOISE.burst_errors * scatter)))
    if not np.any(ratio > least):
        return None
    size = np.ones(len(rough))
    # The window's median falls off before the burst ends.
    for part in runs(binary_dilation(ratio > least, iterations=NOISE.shortest_burst // 4)):
        size[part] = max(float(np.median(rough[part])) / typical, 1.0)
    return size


def _followed(noise: FloatArray) -> FloatArray | None:
    """By a moving mean, drawn towards 1 by as much as chance would move it, where neighbouring sizes are alike."""
    size = np.abs(noise)
    size = np.minimum(size, NOISE.clipped_size * float(np.mean(size)))
    thin = uniform_filter1d(np.abs(np.diff(noise, append=noise[-1])), 3)[:: NOISE.cluster_spacing]
    if len(thin) <= NOISE.fewest_for_clusters or _clusters(thin) <= NOISE.clustered_size:
        return None
    mean = uniform_filter1d(size, NOISE.size_window, mode="reflect")
    mean = np.maximum(mean, NOISE.least_followed_size * float(np.median(mean)))
    logs = np.log(mean / np.mean(mean))
    chance = NOISE.chance_of_sizes * NOISE.size_variance / NOISE.size_window
    keep = max(1.0 - chance / max(float(np.var(logs)), 1e-12), 0.0)
    return np.asarray(np.exp(keep * logs), dtype=np.float64)


def _clusters(size: FloatArray) -> float:
    """Autocorrelation of a size over its first four lags, in standard errors."""
    logs = np.log(np.maximum(size, 1e-3 * float(np.mean(size)) + 1e-300))
    logs = logs - logs.mean()
    variance = float(logs @ logs)
    if variance == 0.0:
        return 0.0
    lags = [float(logs[lag:] @ logs[:-lag]) / variance for lag in range(1, 5)]
    return float(np.sum(lags) * np.sqrt(len(size)) / 2.0)
