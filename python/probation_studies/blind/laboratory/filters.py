"""First-order followers of sampled signals, all samples of a block at once."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    FloatArray = NDArray[np.float64]

BLOCK = 30
"""Samples that are summed at once."""

FORGOTTEN = 22.0
"""Exponent beyond which a memory counts as lost (3e-10 of it); e^(30 x 22) is still a number."""


def decaying_sum(exponent: FloatArray, push: FloatArray) -> FloatArray:
    """Solve s_0 = 0, s_(m+1) = e^(-z_m) s_m + b_m, shape (n,), from `exponent` z and `push` b, shape (n - 1,)."""
    steps = len(push)
    blocks = -(-steps // BLOCK)
    z, b = np.zeros(blocks * BLOCK), np.zeros(blocks * BLOCK)
    z[:steps], b[:steps] = np.minimum(exponent, FORGOTTEN), push
    grown = np.exp(np.cumsum(z.reshape(blocks, BLOCK), axis=1))
    own = np.cumsum(b.reshape(blocks, BLOCK) * grown, axis=1)
    carried = 0.0
    starts = np.empty(blocks)
    for block, (last, growth) in enumerate(zip(own[:, -1].tolist(), grown[:, -1].tolist(), strict=True)):
        starts[block] = carried
        carried = (carried + last) / growth
    found = (starts[:, None] + own) / grown
    return np.concatenate([[0.0], found.ravel()[:steps]])


def low_pass(time: FloatArray, signal: FloatArray, time_constant: float) -> FloatArray:
    """Follow y' = (x - y) / T from y(0) = x(0), exactly for x straight between its samples, shape (n,)."""
    if time_constant <= 0.0:
        return signal
    z = np.diff(time) / time_constant
    return np.asarray(signal - decaying_sum(z, -np.expm1(-z) / z * np.diff(signal)))


def maxwell_element(time: FloatArray, strain: FloatArray, modulus: float, time_constant: float) -> FloatArray:
    """Stress of a spring and a dashpot along a piecewise straight strain, shape (n,)."""
    return np.asarray(modulus * (strain - low_pass(time, strain, time_constant)))
