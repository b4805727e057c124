"""Commanded jumps of the strain rate, found in noisy samples: where the machine was told otherwise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation import _core

if TYPE_CHECKING:
    from probation._arrays import FloatArray

LEAST_CHANGE = 0.3
"""A jump changes the slope by this fraction of the steeper side, or more."""

SIGNIFICANCE = 8.0
"""... and by this many standard errors."""

SMALLEST_WINDOW, LARGEST_WINDOW = 8, 60
CLEAN = 1e-9
"""Strain noise below which the samples are taken as they are."""


@dataclass(frozen=True)
class _Slopes:
    """Straight lines through the `window` samples before and after every sample."""

    before: FloatArray
    after: FloatArray
    standard_error: FloatArray


def find_jumps(time: FloatArray, true_strain: FloatArray, noise: float) -> list[int]:
    """Indices at which the strain rate jumps.

    Clean samples are searched step by step (`History.find_rate_jumps`). Noisy ones are searched with straight lines
    through a window on each side: their slopes must differ by `LEAST_CHANGE` of the steeper one and by `SIGNIFICANCE`
    standard errors (of the samples around, where they scatter more), most so within a window, and both lines must
    describe their samples.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    noise : float
        Standard deviation of the strain's noise [-].

    Returns
    -------
    list of int
        Increasing; neither end is among them.
    """
    if noise < CLEAN:
        return _core.History.find_rate_jumps(time, true_strain)
    window = int(np.clip(len(time) // 60, SMALLEST_WINDOW, LARGEST_WINDOW))
    if len(time) < 4 * window:
        return []
    slopes = _slopes(time, true_strain, window, noise)
    change = np.abs(slopes.after - slopes.before)
    steepest = np.maximum(np.abs(slopes.before), np.abs(slopes.after))
    # A slow part of the record may bend without a jump: its slopes are small beside the record's own speed.
    speed = np.median(np.abs(np.concatenate([slopes.before, slopes.after])))
    stands_out = (change > LEAST_CHANGE * np.maximum(steepest, 0.2 * speed)) & (
        change > SIGNIFICANCE * slopes.standard_error
    )
    jumps: list[int] = []
    candidates = np.flatnonzero(stands_out)
    for index in sorted(candidates, key=lambda i: -change[i]):
        centre = int(index) + window
        apart = all(abs(centre - jump) > window for jump in jumps)
        if apart and _is_sharp(time, true_strain, centre, window, noise, SIGNIFICANCE * slopes.standard_error[index]):
            jumps.append(centre)
    return sorted(jumps)


def _slopes(time: FloatArray, values: FloatArray, window: int, noise: float) -> _Slopes:
    """Least-squares slopes over `window` + 1 samples ending and starting at each interior sample."""
    count = window + 1
    views_t = np.lib.stride_tricks.sliding_window_view(time, count)
    views_y = np.lib.stride_tricks.sliding_window_view(values, count)
    centred = views_t - views_t.mean(axis=1, keepdims=True)
    spread = (centred**2).sum(axis=1)
    slope = (centred * views_y).sum(axis=1) / spread
    interior = slice(window, len(time) - window)
    before = slope[: len(time) - 2 * window]
    after = slope[interior]
    error = noise * np.sqrt(1.0 / spread[: len(before)] + 1.0 / spread[interior])
    return _Slopes(before, after, error)


def _is_sharp(
    time: FloatArray, values: FloatArray, centre: int, window: int, noise: float, least_change: float
) -> bool:
    """Two straight lines that meet near `centre` describe the samples as well as a cubic or better.

    Where the samples scatter more than the record's noise, their slopes must differ by as much more than
    `least_change` [1/s].
    """
    part = slice(centre - window, centre + window + 1)
    t, y = time[part] - time[centre], values[part]
    smooth = np.polynomial.Polynomial.fit(t, y, 3)
    hinge = np.column_stack([np.ones_like(t), t, np.maximum(t, 0.0)])
    solution = np.linalg.lstsq(hinge, y, rcond=None)[0]
    cost_smooth = float(np.sum((y - smooth(t)) ** 2))
    cost_sharp = float(np.sum((y - hinge @ solution) ** 2))
    scatter = float(np.sqrt(cost_sharp / (len(y) - 3)))
    return cost_sharp < cost_smooth + noise**2 and abs(solution[2]) > least_change * max(scatter / noise, 1.0)
