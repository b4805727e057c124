"""The local noise level where a signal is: a short signal may lie in a burst that the noise model has missed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


MEMORY = 35.0 / 18.0
"""Sum of the squared correlations of second differences of white noise, 1 + 2 (2/3)^2 + 2 (1/6)^2."""


def samples_within(directions: FloatArray) -> FloatArray:
    """Number of independent samples under each of the unit signals (N, m), for its noise variance; shape (m,)."""
    square = directions**2
    return np.asarray(1.0 / (MEMORY * np.maximum(np.sum(square * square, axis=0), 1e-300)), dtype=np.float64)


def local_noise_sd(directions: FloatArray, residual: FloatArray, slices: Sequence[slice]) -> FloatArray:
    """Standard deviation of the rough part of a whitened residual, weighted by each signal's square; not below 1.

    Second differences see neither the signals nor the slow noise; each signal is taken off by its own score first.

    Parameters
    ----------
    directions : ndarray, shape (N, m)
        Unit signals.
    residual : ndarray, shape (N,)
        Whitened.
    slices : sequence of slice
        Rows of each record.

    Returns
    -------
    ndarray, shape (m,)
    """
    scores = directions.T @ residual
    power, weight = np.zeros(len(scores)), np.zeros(len(scores))
    for part in slices:
        own, values = directions[part], residual[part]
        if len(values) < 3:
            continue
        rough, bent = np.diff(values, 2) / np.sqrt(6.0), np.diff(own, 2, axis=0) / np.sqrt(6.0)
        square = own[1:-1] ** 2
        power += square.T @ rough**2
        power += -2.0 * scores * ((square * bent).T @ rough) + scores**2 * np.sum(square * bent**2, axis=0)
        weight += square.sum(axis=0)
    variance = np.divide(power, weight, out=np.ones_like(power), where=weight > 0.0)
    return np.asarray(np.sqrt(np.maximum(variance, 1.0)), dtype=np.float64)
