"""First-order followers of sampled signals."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation.blind.laboratory.material import FloatArray


def low_pass(time: FloatArray, signal: FloatArray, time_constant: float) -> FloatArray:
    """Follow y' = (x - y) / T from y(0) = x(0), exactly for x straight between its samples, shape (n,)."""
    if time_constant <= 0.0:
        return signal
    z = np.diff(time) / time_constant
    fades, pushes = np.exp(-z).tolist(), (-np.expm1(-z) / z * np.diff(signal)).tolist()
    behind = [0.0]
    for fade, push in zip(fades, pushes, strict=True):
        behind.append(fade * behind[-1] + push)
    return np.asarray(signal - np.array(behind))


def maxwell_element(time: FloatArray, strain: FloatArray, modulus: float, time_constant: float) -> FloatArray:
    """Stress of a spring and a dashpot along a piecewise straight strain, shape (n,)."""
    return np.asarray(modulus * (strain - strain[0] - (low_pass(time, strain, time_constant) - strain[0])))
