"""Noise that rises towards low frequencies (1/f) where nothing can be measured of it: extrapolated, not ignored.

Below the dozenth half period of a record a bias would show first, so that `estimate_noise` looks at rougher leftovers.
Slow electronics, a drifting laboratory: noise whose power falls as 1/k with the order k of a cosine wave shows there as a
slight rise, and is many times the white noise at k = 1. A bias is smoother than that: its power falls as k^-4, or k^-2
where the stress itself jumps. So the rise beyond the dozenth half period tells how much of the slow waves is noise.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import dct

from probation.gap.smooth_basis import WAVES, waves

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.gap.noise_model import NoiseModel
    from probation.gap.whitening import Whitened

LEAST = 1.0
"""Relative variance at the first half period that is assumed in any case: less cannot be told from none."""

SIZES = np.append(0.0, np.geomspace(0.5, 500.0, 24))
"""Relative variances at the first half period that are tried, all as probable beforehand."""

HIGHEST = 4
"""Orders up to the samples over this are looked at."""

OUTLYING = 8.0
"""Power of one wave, over the mean, above which it is a line and no noise."""

MODELLED = 48
"""Orders that are given their drift; the roughest of them have little."""

FEW = 64


def estimate_drift(whitened: Whitened) -> float:
    """Variance of the first half period over the white noise's, the records' common one; power falls as 1/order.

    Whittle's likelihood of (1 + c/k) at the orders beyond the dozenth, each record at its own level; the mean over c.

    Parameters
    ----------
    whitened : Whitened
        Without any drift in its noises.
    """
    score = np.zeros(len(SIZES))
    for part in whitened.slices:
        count = part.stop - part.start
        if count < FEW:
            continue
        order = np.arange(WAVES, count // HIGHEST)
        power = dct(whitened.residual[part], type=2, norm="ortho")[order] ** 2
        power = np.minimum(power, OUTLYING * float(np.mean(power)))
        for index, size in enumerate(SIZES):
            shape = 1.0 + size / order
            score[index] -= 0.5 * (len(order) * np.log(np.mean(power / shape)) + np.sum(np.log(shape)))
    weight = np.exp(score - score.max())
    return max(float(weight @ SIZES / weight.sum()), LEAST)


def with_drift(noise: NoiseModel, size: float) -> NoiseModel:
    """The noise with a drift of that relative variance at the first half period on top.

    Parameters
    ----------
    noise : NoiseModel
    size : float
        From `estimate_drift`.
    """
    columns = waves(len(noise), min(MODELLED, len(noise) // HIGHEST))
    order = np.maximum(np.arange(columns.shape[1]), 1)
    slow: FloatArray = noise.long_run[:, None] * columns * np.sqrt(size / order)
    return replace(noise, carried=np.hstack([noise.carried, slow]))
