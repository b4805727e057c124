"""How much the samples of many pixels scatter, without a model of what they measure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.source import Samples

SPAN, MOST = 40, 8
"""Samples of a part of the record with a noise of its own, at least, and parts at most."""

_MEDIAN_TO_DEVIATION = 1.482602218505602  # of a normal distribution


def scatter(time: FloatArray, values: Samples) -> FloatArray:
    """Standard deviation of white noise along each record, from third divided differences: they cancel any parabola.

    The median over each part of a record shuts out jumps. Noise that is correlated from sample to sample is
    underestimated.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
        Increasing; at least 4.
    values : ndarray, shape (pixels, n_times)

    Returns
    -------
    ndarray, shape (pixels, n_times) [as the values]
        Constant over each part.
    """
    nodes = np.lib.stride_tricks.sliding_window_view(time, 4)
    weight = 1.0 / np.prod(nodes[:, :, None] - nodes[:, None, :] + np.eye(4), axis=2)
    weight /= np.linalg.norm(weight, axis=1, keepdims=True)
    last = values.shape[1] - 3
    difference = np.abs(sum(weight[:, k] * values[:, k : k + last] for k in range(4)))
    parts = int(np.clip(values.shape[1] // SPAN, 1, MOST))
    found = [np.median(part, axis=1) for part in np.array_split(difference, parts, axis=1)]
    lengths = [len(part) for part in np.array_split(time, parts)]
    return np.asarray(_MEDIAN_TO_DEVIATION * np.repeat(np.stack(found, axis=1), lengths, axis=1))
