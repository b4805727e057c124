"""Commanded discontinuities of the strain rate, found in noisy samples: where the command to the machine changes."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import maximum_filter1d

from probation import _core
from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from probation._arrays import FloatArray

SMALLEST_WINDOW, LARGEST_WINDOW = 8, 60
WIDER = (1, 3, 5)
"""Windows so many times larger are searched: noisier jumps stand out in the larger ones, such as the end of a wait."""


@dataclass(frozen=True)
class _Slopes:
    """Straight lines through the `window` samples before and after every sample."""

    before: FloatArray
    after: FloatArray
    standard_error: FloatArray


def find_jumps(time: FloatArray, true_strain: FloatArray, noise: float) -> list[int]:
    """Indices at which the strain rate is discontinuous.

    Clean samples are searched step by step (`History.find_rate_jumps`). Noisy ones are searched with straight lines
    through a window on each side: their slopes must differ by `least_jump` of the steeper one and by
    `jump_significance` standard errors (of the samples around, where they scatter more), most so within a window, and
    the corner between them must describe the samples better than a cubic by `jump_evidence`. It is put where it
    leaves least.

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
    if noise < SMOOTHING.clean:
        return _core.History.find_rate_jumps(time, true_strain)
    jumps: list[int] = []
    smallest = int(np.clip(len(time) // 60, SMALLEST_WINDOW, LARGEST_WINDOW))
    for window in (factor * smallest for factor in WIDER):
        if len(time) >= 4 * window:
            jumps += _jumps_in_windows(time, true_strain, noise, window, jumps)
    borders = [0, *sorted(jumps), len(time) - 1]
    return [
        _placed(time, true_strain, jump, smallest, (before, after), noise)
        for before, jump, after in zip(borders, borders[1:], borders[2:], strict=False)
    ]


def _placed(
    time: FloatArray, values: FloatArray, jump: int, window: int, between: tuple[int, int], noise: float
) -> int:
    """Where two lines meet that describe the samples around a jump, in the largest window that they describe.

    Lines through few samples place a corner only to within noise over change of slope, which may be several samples;
    the error falls with the root of the number of samples. They are straight unless parabolas leave less by
    `SMOOTHING.jump_evidence`.
    """
    while window <= min(jump - between[0], between[1] - jump) - 1:
        part = slice(jump - window, jump + window + 1)
        t, y = (time[part] - time[jump]) / (time[part][-1] - time[part][0]), values[part]
        offsets = range(-(window // 2), window // 2 + 1)
        straight, bent = (
            np.array([_left(t, y, t[window + offset], degree) for offset in offsets]) for degree in (1, 2)
        )
        left = straight if straight.min() < bent.min() + SMOOTHING.jump_evidence * noise**2 else bent
        if left.min() > len(y) * (SMOOTHING.placed_scatter * noise) ** 2:
            break
        jump += offsets[int(np.argmin(left))]
        window *= 2
    return jump


def _left(time: FloatArray, values: FloatArray, corner: float, degree: int) -> float:
    """Sum of squares around two polynomials that meet at a corner."""
    behind = np.maximum(time - corner, 0.0)
    powers = [sign**power for power in range(1, degree + 1) for sign in (time, behind)]
    basis = np.column_stack([np.ones_like(time), *powers])
    return float(np.linalg.lstsq(basis, values, rcond=None)[1].sum())


def _jumps_in_windows(
    time: FloatArray, true_strain: FloatArray, noise: float, window: int, known: list[int]
) -> list[int]:
    """Jumps that windows of one size show, none within a window of a known one."""
    slopes = _slopes(time, true_strain, window, noise)
    change = np.abs(slopes.after - slopes.before)
    steepest = np.maximum(np.abs(slopes.before), np.abs(slopes.after))
    # A slow part of the record may bend without a jump: its slopes are small against the record's own rate.
    speed = np.median(np.abs(np.concatenate([slopes.before, slopes.after])))
    stands_out = (
        (change > SMOOTHING.least_jump * np.maximum(steepest, SMOOTHING.least_part_of_speed * speed))
        & (change > SMOOTHING.jump_significance * slopes.standard_error)
        & (change == maximum_filter1d(change, window))
    )
    jumps: list[int] = []
    for index in sorted(np.flatnonzero(stands_out), key=lambda i: -change[i]):
        centre = int(index) + window
        if any(abs(centre - jump) <= window for jump in known + jumps):
            continue
        corner = _corner(time, true_strain, centre, window, noise)
        if (
            corner is not None
            and corner.change > SMOOTHING.jump_significance * slopes.standard_error[index] * corner.scatter / noise
        ):
            jumps.append(corner.at)
    return jumps


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


@dataclass(frozen=True)
class _Corner:
    """Two straight lines that meet at a sample: how much their slopes differ [1/s], and how much they leave [-]."""

    at: int
    change: float
    scatter: float


def _corner(time: FloatArray, values: FloatArray, centre: int, window: int, noise: float) -> _Corner | None:
    """The corner around `centre` that leaves least, if it leaves `jump_evidence` less than the best cubic.

    A smooth curve that bends much has different slopes on either side, too, but a cubic describes it as well.
    """
    part = slice(centre - window, centre + window + 1)
    t, y = time[part] - time[centre], values[part]
    smooth = np.polynomial.Polynomial.fit(t, y, 3)
    least = np.inf
    for offset in range(-(window // 2), window // 2 + 1):
        hinge = np.column_stack([np.ones_like(t), t, np.maximum(t - t[window + offset], 0.0)])
        solution = np.linalg.lstsq(hinge, y, rcond=None)[0]
        cost = float(np.sum((y - hinge @ solution) ** 2))
        if cost < least:
            least, best, change = cost, offset, abs(float(solution[2]))
    scatter = max(float(np.sqrt(least / (len(y) - 3))), noise)
    evidence = float(np.sum((y - smooth(t)) ** 2)) - least
    return _Corner(centre + best, change, scatter) if evidence > SMOOTHING.jump_evidence * scatter**2 else None
