"""Noise that comes in bursts: its size along a record."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view
from scipy.ndimage import uniform_filter1d

from probation.noise.regions import runs
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Iterator

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
    followed = _followed(noise)
    return bursts(noise) if followed is None else followed


def bursts(noise: FloatArray) -> FloatArray | None:
    """As `local_size`, by what the best of some simple curves leaves in short windows.

    A step, a kink, an outlier, or a step that fades, leaves nothing there. The cube root of a sum of squares is close
    to normal (Wilson and Hilferty 1931).
    """
    rough = np.abs(np.diff(noise, 2))
    typical = float(np.median(rough)) if len(rough) else 0.0
    if len(noise) < 4 * max(NOISE.burst_windows) or typical == 0.0:
        return None
    rough = np.pad(rough, 1, mode="edge")
    size = np.ones(len(noise))
    roots = [np.cbrt(_left_in_windows(noise, width)) for width in NOISE.burst_windows]
    for errors in (NOISE.burst_errors, NOISE.further_burst_errors):
        for root, width in zip(roots, NOISE.burst_windows, strict=True):
            for burst in _loud(root, width, errors):
                ratio = float(np.median(rough[burst])) / typical
                if ratio > NOISE.burst_ratio:
                    size[burst] = np.maximum(size[burst], ratio)
        if not 0.0 < np.mean(size > 1.0) <= NOISE.most_in_bursts:
            return None
    return size


def _loud(root: FloatArray, width: int, errors: float) -> Iterator[slice]:
    """Samples of the windows that are so many standard deviations above the usual one, (n - width + 1,)."""
    usual = float(np.median(root))
    scatter = float(np.median(np.abs(root - usual))) / MEDIAN_OF_NORMAL
    for starts in runs(root > max(usual + errors * scatter, usual * NOISE.burst_ratio ** (2.0 / 3.0))):
        loudest = starts.start + int(np.argmax(root[starts]))
        # A window is loud once a third of it lies in the burst; the loudest is all in it.
        begin = min(starts.start + width // 3, loudest)
        yield slice(begin, max(starts.stop - 1 + width - width // 3, loudest + width))


def _left_in_windows(noise: FloatArray, width: int) -> FloatArray:
    """Sum of squares that the best of the fits of `_window_fits` leaves in every window, (n - width + 1,)."""
    windows = sliding_window_view(noise, width)
    whole = np.sum(windows**2, axis=1)
    taken = np.max([np.sum((windows @ basis) ** 2, axis=1) for basis in _window_fits(width)], axis=0)
    return np.asarray(np.maximum(whole - taken, 0.0), dtype=np.float64)


@cache
def _window_fits(width: int) -> tuple[FloatArray, ...]:
    """Orthonormal bases, at every sample: two lines that meet nowhere, a line and an outlier, a line and what fades."""
    sample = np.arange(width, dtype=np.float64)
    line = [np.ones(width), sample - sample.mean()]
    outliers = [[*line, np.eye(width)[place]] for place in range(width)]
    lines, fading = [], []
    for place in range(1, width - 1):
        since = sample - place
        after = (since >= 0.0).astype(np.float64)
        if place > 1:
            lines.append([*line, after, after * since])
        fading += [[*line, after, after * np.exp(-np.maximum(since, 0.0) / time)] for time in NOISE.fading_samples]
    return tuple(np.linalg.qr(np.column_stack(columns))[0] for columns in lines + outliers + fading)


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
