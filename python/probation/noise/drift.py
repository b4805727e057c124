"""Noise that rises towards low frequencies (1/f) where nothing can be measured of it: extrapolated, not ignored.

Below the dozenth half period of a record a bias would show first, so that `estimate_noise` fits its ARMA process to
nothing slower. Slow electronics, a drifting laboratory: noise whose power falls as 1/k with the order k of a cosine
wave shows there as a slight rise, and is many times the white noise at k = 1. A bias is smoother: its power falls as
k^-2 to k^-4. So the spectrum of what that process whitens, 1 + c/k + d/k^3, tells how much of the slow waves is noise.
It is fitted from the eighth half period on (`NOISE.lowest_drift_order`), d standing for a bias: it takes what a gap
makes there.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.fft import dct
from scipy.special import logsumexp

from probation.noise.smooth_basis import waves
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel
    from probation.noise.whitening import Whitened


SIZES = np.append(0.0, np.geomspace(*NOISE.drift_range, 20))
"""Relative variances at the first half period that are tried."""

BIASES = np.append(0.0, np.geomspace(*NOISE.bias_range, 13))
"""The same for a bias whose power falls as 1/order^3, extrapolated to the first half period."""


def estimate_drift(whitened: Whitened) -> float:
    """Variance of the first half period over the white noise's, the records' common one; power falls as 1/order.

    Whittle's likelihood of 1 + c/k + d/k^3, each record with its own level and bias d, one in five with its own c, too:
    a fault that is sharp in one record must not decide on the others' noise. The mean, and part of a standard deviation
    more, since too little makes gaps of noise.

    Parameters
    ----------
    whitened : Whitened
        Without any drift in its noises.
    """
    score = -np.log1p(SIZES / NOISE.usual_drift)
    for part in whitened.slices:
        count = part.stop - part.start
        if count < NOISE.fewest_for_drift:
            continue
        order = np.arange(NOISE.lowest_drift_order, count // NOISE.highest_drift_order)
        power = dct(whitened.residual[part], type=2, norm="ortho")[order] ** 2
        own = logsumexp(_scores(order, np.minimum(power, NOISE.outlying_power * float(np.mean(power)))), axis=1)
        score += np.logaddexp(
            np.log(1.0 - NOISE.records_apart) + own, np.log(NOISE.records_apart / len(SIZES)) + logsumexp(own)
        )
    weight = np.exp(score - score.max())
    chance = weight / weight.sum()
    mean = float(chance @ SIZES)
    return max(mean + NOISE.drift_margin * float(np.sqrt(chance @ (SIZES - mean) ** 2)), NOISE.least_drift)


def like_an_effect(drift: float) -> float:
    """Relative variance of a drift at the first half period that may go along with an effect."""
    return float(
        np.clip(NOISE.drift_share_of_effects * drift, NOISE.least_drift_of_effects, NOISE.most_drift_of_effects)
    )


def _scores(order: FloatArray, power: FloatArray) -> FloatArray:
    """Log likelihoods over the grid, the level profiled out; shape (n_sizes, n_biases)."""
    shape = 1.0 + SIZES[:, None, None] / order + BIASES[:, None] / order**3.0
    level = np.mean(power / shape, axis=2)
    return np.asarray(-0.5 * (len(order) * np.log(level) + np.sum(np.log(shape), axis=2)))


def with_drift(noise: NoiseModel, size: float, nuisance: float = 0.0, time: FloatArray | None = None) -> NoiseModel:
    """The noise with a drift of that relative variance at the first half period on top.

    Parameters
    ----------
    noise : NoiseModel
    size : float
        In all directions.
    nuisance : float
        More of it, that is like no effect.
    time : ndarray, shape (n,) [s], optional
        What drifts does so in time: many samples within a short while drift together. Even steps if left out.
    """
    columns = waves(len(noise), min(NOISE.modelled_drift_orders, len(noise) // NOISE.highest_drift_order), time)
    order = np.maximum(np.arange(columns.shape[1]), 1)
    slow: FloatArray = noise.long_run[:, None] * columns / np.sqrt(order)
    more = np.sqrt(nuisance) * slow if nuisance > 0.0 else None
    return replace(noise, drift=np.sqrt(size) * slow, nuisance_drift=more)
