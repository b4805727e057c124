"""Plain differences of measured strain, and how much they scatter."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray

NAME = "three-point central difference"


def differences(time: FloatArray, values: FloatArray) -> FloatArray:
    """Slope of the parabola through each sample and its neighbours, the secant at the ends; along the first axis."""
    return np.asarray(np.gradient(values, time, axis=0))


def differences_error(time: FloatArray) -> FloatArray:
    """Standard error of `differences` of white noise of standard deviation 1, shape (n_times,) [1/s]."""
    step = np.diff(time)
    before, after = step[:-1], step[1:]
    whole = before + after
    weights = (-after / (before * whole), (after - before) / (before * after), before / (after * whole))
    inner = np.sqrt(sum(weight**2 for weight in weights))
    return np.concatenate([[np.sqrt(2.0) / step[0]], inner, [np.sqrt(2.0) / step[-1]]])


def differences_transposed(time: FloatArray, rows: FloatArray) -> FloatArray:
    """``rows @ D`` of the matrix D of `differences`, for rows of shape (p, n_times)."""
    step = np.diff(time)
    before, after = step[:-1], step[1:]
    whole = before + after
    inner = rows[:, 1:-1]
    turned = np.zeros_like(rows)
    turned[:, :-2] -= inner * after / (before * whole)
    turned[:, 1:-1] += inner * (after - before) / (before * after)
    turned[:, 2:] += inner * before / (after * whole)
    turned[:, :2] += rows[:, :1] * np.array([-1.0, 1.0]) / step[0]
    turned[:, -2:] += rows[:, -1:] * np.array([-1.0, 1.0]) / step[-1]
    return turned
