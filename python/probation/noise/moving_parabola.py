"""A parabola through a moving window of samples (Savitzky & Golay 1964): the slow part of a record."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import correlate1d

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def parabola_weights(window: int) -> FloatArray:
    """Weights of the samples of an odd window in the parabola's value at its middle, shape (window,)."""
    half = window // 2
    place = np.arange(-half, half + 1)
    norm = (2 * half + 3) * (2 * half + 1) * (2 * half - 1) / 3.0
    return np.asarray((3 * half**2 + 3 * half - 1 - 5.0 * place**2) / norm)


def moving_parabola(values: FloatArray, window: int) -> FloatArray:
    """Samples along axis 0 through the moving parabola; the first and last half window lie on that of the ends.

    Parameters
    ----------
    values : ndarray, shape (n,) or (n, m)
    window : int
        Samples, odd, from 3 to n.
    """
    half = window // 2
    smooth = np.asarray(correlate1d(values, parabola_weights(window), axis=0, mode="nearest"), dtype=np.float64)
    powers = np.vander(np.arange(window) / window, 3)
    for end, ends in ((slice(0, half), slice(0, window)), (slice(len(values) - half, None), slice(-window, None))):
        curve = np.linalg.lstsq(powers, values[ends], rcond=None)[0]
        smooth[end] = (powers[:half] if end.start == 0 else powers[window - half :]) @ curve
    return smooth
