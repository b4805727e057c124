"""How much the samples of many pixels scatter, without a model of what they measure."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.normal import SD_OF_MEDIAN
from probation.settings.field import FIELD

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.samples import IndexArray
    from probation.field.source import Samples


def scatter(time: FloatArray, values: Samples, neighbourhood: IndexArray) -> FloatArray:
    """Standard deviation of white noise along each record, from third divided differences: they cancel any parabola.

    How it changes along the record is that of the neighbourhood, part by part; how large it is, each record's own.
    Medians shut out jumps. Their squares are right in the mean, for standard errors are pooled as squares. Noise that
    is correlated from sample to sample is underestimated.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
        Increasing; at least 4.
    values : ndarray, shape (pixels, n_times)
    neighbourhood : ndarray of int, shape (pixels,)
        Its number for each pixel.

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
    parts = int(np.clip(values.shape[1] // FIELD.noise_part, 1, FIELD.most_noise_parts))
    pieces = np.array_split(difference, parts, axis=1)
    shape = np.stack([_pooled(_deviation(piece), neighbourhood) for piece in pieces], axis=1)
    of_differences = np.repeat(shape, [piece.shape[1] for piece in pieces], axis=1)
    size = _deviation(np.divide(difference, of_differences, out=np.zeros_like(difference), where=of_differences > 0.0))
    lengths = [len(part) for part in np.array_split(time, parts)]
    return np.asarray(size[:, None] * np.repeat(shape, lengths, axis=1))


def _deviation(differences: FloatArray) -> FloatArray:
    """From the moduli of differences, along the rows."""
    few = np.sqrt(1.0 + FIELD.excess_of_squared_median / differences.shape[1])
    return np.asarray(SD_OF_MEDIAN / few * np.median(differences, axis=1))


def _pooled(deviation: FloatArray, neighbourhood: IndexArray) -> FloatArray:
    """Root mean square over each pixel's neighbourhood, shape (pixels,)."""
    _, place, count = np.unique(neighbourhood, return_inverse=True, return_counts=True)
    return np.asarray(np.sqrt(np.bincount(place, weights=deviation**2) / count)[place])
