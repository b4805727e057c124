"""Commanded discontinuities of the strain rate, found in noisy samples: where the command to the machine changes."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import combinations, pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import maximum_filter1d, median_filter

from probation import _core
from probation.normal import SD_OF_MEDIAN
from probation.records.noise import noise_level
from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


@dataclass(frozen=True)
class _Slopes:
    """Straight lines through the `window` samples before and after every sample."""

    before: FloatArray
    after: FloatArray
    standard_error: FloatArray


def find_jumps(
    time: FloatArray, true_strain: FloatArray, noise: float, true_stress: FloatArray | None = None
) -> list[int]:
    """Indices at which the strain rate is discontinuous.

    Clean samples are searched step by step (`History.find_rate_jumps`). Noisy ones are searched with straight lines
    through a window on each side: their slopes must differ by `least_jump` of the steeper one and by
    `jump_significance` standard errors (of the samples around, where they scatter more), most so within a window, and
    the corner between them must describe the samples better than a cubic by `jump_evidence`. It is put where it
    leaves least. Two that are closer than a window show as one (`_as_two`). Where the stress has a corner, the
    strain needs to confirm no more than that (`_with_stress`). What is a machine's lag behind its command is none
    (`_without_lags`). Where the strain itself takes a step, both ends of that are jumps of its rate (`_steps`).

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    noise : float
        Standard deviation of the strain's noise [-].
    true_stress : ndarray, shape (n_times,) [MPa], optional

    Returns
    -------
    list of int
        Increasing; neither end is among them.
    """
    if noise < SMOOTHING.clean:
        return _core.History.find_rate_jumps(time, true_strain)
    if steps := _steps(time, true_strain, noise):
        true_strain = _without_steps(time, true_strain, steps)
    ends = {end for step in steps for end in step if 0 < end < len(time) - 1}
    return sorted(ends | set(_jumps_of_noisy_strain(time, true_strain, noise, true_stress)))


def _jumps_of_noisy_strain(
    time: FloatArray, true_strain: FloatArray, noise: float, true_stress: FloatArray | None
) -> list[int]:
    """The jumps of a noisy strain that takes no step; as in `find_jumps`."""
    seen = _jumps_in_noise(time, true_strain, noise)
    jumps = sorted(
        {
            place
            for at, jump, to in _between(seen, len(time))
            for place in _as_two(time, true_strain, noise, jump, (at, to))
        }
    )
    stress_noise = 0.0 if true_stress is None else noise_level(time, true_stress)
    corners: list[int] = []
    if true_stress is not None and stress_noise > 0.0:
        seen = _jumps_in_noise(time, true_stress, stress_noise)
        jumps = _with_stress(time, true_strain, noise, jumps, seen)
        corners = _without_lags(time, true_stress, stress_noise, seen, bends=True)
    return [
        jump if jump in corners else _begun(time, true_strain, noise, jump, (before, after))
        for before, jump, after in _between(_without_lags(time, true_strain, noise, jumps, corners), len(time))
    ]


def _steps(time: FloatArray, values: FloatArray, noise: float) -> list[tuple[int, int]]:
    """Between which samples noisy ones take a step, as where a strip or an extensometer slips: its ends.

    A few changes from sample to sample stand out from those around: beyond the scatter of the record's, by more than
    the usual change, and much further than those next to them.
    """
    usual = _usual_changes(time, values)
    more = np.abs(np.diff(values) - usual)
    scatter = max(np.sqrt(2.0) * noise, SD_OF_MEDIAN * float(np.median(more)))
    out = np.concatenate([[False], more > SMOOTHING.step_significance * scatter, [False]])
    steps = []
    for first, last in np.flatnonzero(out[1:] != out[:-1]).reshape(-1, 2).tolist():
        before, after = more[max(first - SMOOTHING.longest_step, 0) : first], more[last : last + SMOOTHING.longest_step]
        others = SMOOTHING.step_over_others * max(before.max(initial=0.0), after.max(initial=0.0))
        if last - first <= SMOOTHING.longest_step and more[first:last].max() > max(abs(usual[first]), others):
            steps.append((first, last))
    return steps


def _without_steps(time: FloatArray, values: FloatArray, steps: Sequence[tuple[int, int]]) -> FloatArray:
    """The same going on over each step as it does around it."""
    changes, usual = np.diff(values), _usual_changes(time, values)
    for first, last in steps:
        changes[first:last] = usual[first:last]
    return np.asarray(values[0] + np.concatenate([[0.0], np.cumsum(changes)]))


def _usual_changes(time: FloatArray, values: FloatArray) -> FloatArray:
    """Changes from sample to sample at the median of the rates around, among which those of a step are few."""
    rates = np.diff(values) / np.diff(time)
    return np.asarray(median_filter(rates, 4 * SMOOTHING.longest_step + 1, mode="nearest") * np.diff(time))


def _jumps_in_noise(time: FloatArray, values: FloatArray, noise: float) -> list[int]:
    """Indices at which the slope of noisy samples is discontinuous, increasing."""
    jumps: list[int] = []
    smallest = _smallest_window(time)
    for window in (factor * smallest for factor in SMOOTHING.wider_jump_windows):
        if len(time) >= 4 * window:
            jumps += _jumps_in_windows(time, values, noise, window, jumps)
    placed = {
        _placed(time, values, jump, smallest, (before, after), noise)
        for before, jump, after in _between(jumps, len(time))
    }
    return sorted(placed)


def _as_two(time: FloatArray, values: FloatArray, noise: float, jump: int, between: tuple[int, int]) -> list[int]:
    """A jump, or two in its place: where two corners describe the samples around it, and one does not.

    A ramp that takes fewer samples than a window has a corner at its start and one at its end, and a window shows one
    somewhere between. Corners lie between samples, too. A machine that lags bends over many samples: two corners count
    only where they leave less than a lag does, and no more than the noise, or a small part of what one leaves.
    """
    most = 2 * _smallest_window(time)
    part = slice(max(between[0], jump - most), min(between[1], jump + most) + 1)
    t, y = (time[part] - time[jump]) / (time[part][-1] - time[part][0]), values[part]
    interval = float(np.median(np.diff(t)))
    bent = np.column_stack([np.ones_like(t), t, t**2])
    behind = [np.maximum(t - at, 0.0) for at in t]
    inner = range(1, len(t) - 3)

    def around(*corners: int, curve: FloatArray = y) -> tuple[float, list[int]]:
        """What corners leave, each between a sample and the next, and the samples nearest to them.

        A hinge at both samples is one anywhere between, if both bend the same way. Where the corner lies at the first
        sample, noise alone may bend the second hinge the other way: then it is left out. The slopes must differ enough.
        """
        basis = np.column_stack([bent, *(behind[at + own] for at in corners for own in (0, 1))])
        solution = np.linalg.lstsq(basis, curve, rcond=None)[0]
        opposite = solution[3::2] * solution[4::2] < 0.0
        if opposite.any():
            basis[:, 4::2][:, opposite] = 0.0
            solution = np.linalg.lstsq(basis, curve, rcond=None)[0]
        here, beyond = solution[3::2], solution[4::2]
        change = here + beyond
        after = solution[1] + 2.0 * solution[2] * t[[*corners]] + np.cumsum(change)
        steepest = np.maximum(np.abs(after), np.abs(after - change))
        if np.any(here * beyond < 0.0) or np.any(np.abs(change) < SMOOTHING.least_jump * steepest):
            return np.inf, []
        nearest = [
            part.start + at + int(later) for at, later in zip(corners, np.abs(beyond) > np.abs(here), strict=True)
        ]
        return float(np.sum((curve - basis @ solution) ** 2)), nearest

    def left_lagging(since: FloatArray, lag: float) -> float:
        return _left_by(np.column_stack([bent, _turned(since, lag)]), y)

    described = len(t) * (SMOOTHING.placed_scatter * noise) ** 2
    one = min((around(at, curve=curve)[0] for at in inner for curve in (y, _nominal(y))), default=0.0)
    if one <= described:
        return [jump]
    two, corners = min(
        (around(at, other) for at, other in combinations(inner, 2) if other > at + 1), default=(np.inf, [])
    )
    lagging = min(left_lagging(since, lag * interval) for since in behind[1:-1] for lag in SMOOTHING.lag_times)
    scale = max(noise, float(np.sqrt(two / len(t))))
    shows_two = (
        two <= max(described, SMOOTHING.left_by_two * one) and two < lagging - SMOOTHING.jump_evidence * scale**2
    )
    return corners if shows_two else [jump]


def _smallest_window(time: FloatArray) -> int:
    return int(
        np.clip(len(time) // SMOOTHING.jump_windows, SMOOTHING.smallest_jump_window, SMOOTHING.largest_jump_window)
    )


def _with_stress(
    time: FloatArray, true_strain: FloatArray, noise: float, jumps: Sequence[int], corners: Sequence[int]
) -> list[int]:
    """Jumps of the strain rate, with what corners of the stress say of them.

    A law that is stiff at once makes a corner in the stress of every jump of the rate: at the end of a wait the force
    rises from that very sample on. The force often shows it a hundred times as sharply as a noisy strain does. So a
    jump moves to a corner of the stress unless the strain's own samples refute that (by `stress_corner`); and a corner
    where the strain alone shows no jump is one if the slopes of the strain differ there by `least_jump` and
    `stress_corner` standard errors, and no cubic describes the samples better by as much: the place is known, and
    needs no search.
    """
    corrected = sorted(jumps)
    reach = SMOOTHING.wider_jump_windows[-1] * _smallest_window(time)
    for corner in corners:
        near = min(corrected, key=lambda jump: abs(jump - corner), default=None)
        others = [jump for jump in corrected if jump != near]
        if near is not None and abs(near - corner) <= reach:
            if near != corner and _agrees(time, true_strain, noise, near, corner, others):
                corrected = sorted({*others, corner})
        elif _is_jump(time, true_strain, noise, corner, corrected):
            corrected = sorted([*corrected, corner])
    return corrected


def _without_lags(
    time: FloatArray,
    values: FloatArray,
    noise: float,
    jumps: Sequence[int],
    sharp: Sequence[int] = (),
    *,
    bends: bool = False,
) -> list[int]:
    """Jumps without those at which a machine is only getting up to the speed of the start, or of the jump before.

    A first-order lag behind a change of the command bends the strain within some time constants. Two lines describe
    that better than a cubic does; a parabola with a fading exponential describes it as well as they do. The stress may
    show that a jump is sharp; then it is no lag. The stress `bends` by itself: a cubic and parabolas stand for the
    parabola and the lines.
    """
    kept: list[int] = []
    borders = [*jumps, len(time) - 1]
    for jump, after in pairwise(borders):
        before = kept[-1] if kept else 0
        if jump in sharp or not _is_lag(time, values, noise, (before, jump, after), bends=bends):
            kept.append(jump)
    return kept


def _between(jumps: Sequence[int], count: int) -> list[tuple[int, int, int]]:
    """Every jump between the one before it, or the start, and the one after it, or the end."""
    borders = [0, *sorted(jumps), count - 1]
    return list(zip(borders, borders[1:], borders[2:], strict=False))


def _begun(time: FloatArray, values: FloatArray, noise: float, jump: int, between: tuple[int, int]) -> int:
    """Where a jump begins behind which the machine lags: two lines meet a time constant after that.

    The rate goes from one value to another as a first-order lag does; where this does not describe the samples better
    by `jump_evidence` than a sharp corner does, between samples as well, the jump is sharp, and stays. It is the rate
    of the strain, or the crosshead's speed: then the strain bends, and before the jump by more than behind it.
    """
    reach = round(max(SMOOTHING.lag_times))
    first = min(max(between[0] + 2, jump - reach), jump)
    part = slice(max(between[0], first - 2 * reach), min(between[1], jump + round(SMOOTHING.lag_reach * reach)) + 1)
    t, y = time[part], values[part]
    curves = (y, _nominal(y))
    interval = float(np.median(np.diff(time[jump : jump + SMOOTHING.border_samples + 1])))

    def left(begin: float, lag: float) -> float:
        turned = _turned(np.maximum(t - begin, 0.0), lag)
        basis = np.column_stack([np.ones_like(t), t - begin, (t - begin) ** 2, turned])
        return min(_left_by(basis, curve) for curve in curves)

    near = time[max(jump - 2, first) : min(jump + 3, between[1] + 1)]
    places = np.arange(SMOOTHING.corner_places * (len(near) - 1) + 1) / SMOOTHING.corner_places
    sharp = min(left(at, 0.0) for at in np.interp(places, np.arange(len(near)), near))
    lagging, begun = min(
        (left(time[at], lag * interval), at) for at in range(first, jump + 1) for lag in SMOOTHING.lag_times
    )
    scale = max(noise, float(np.sqrt(lagging / len(t))))
    return begun if lagging < sharp - SMOOTHING.jump_evidence * scale**2 else jump


def _nominal(true_strain: FloatArray) -> FloatArray:
    """The stretch over its root mean square: straight at a constant crosshead speed, with the errors of the strain."""
    stretch = np.exp(true_strain - np.mean(true_strain))
    return np.asarray(stretch / np.sqrt(np.mean(stretch**2)))


def _turned(since: FloatArray, lag: float) -> FloatArray:
    """What a rate that changes by one makes of the strain, so long since; behind a first-order lag, if there is one."""
    return since + lag * np.expm1(-since / lag) if lag > 0.0 else since


def _is_lag(time: FloatArray, values: FloatArray, noise: float, at: tuple[int, int, int], *, bends: bool) -> bool:
    """Whether samples bend at a jump as behind the jump before, or the start: `at` are both, and the jump after."""
    before, jump, after = at
    if jump - before > SMOOTHING.lag_reach * max(SMOOTHING.lag_times):
        return False
    part = slice(before, min(after, 2 * jump - before + _smallest_window(time)) + 1)
    t, y = (time[part] - time[before]) / (time[part][-1] - time[before]), values[part]
    places = range(max(jump - before - 2, 1), min(jump - before + 3, len(t) - 1))
    corner = min(_left(t, y, t[at], degree) for at in places for degree in ((1, 2) if bends else (1,)))
    if not bends:
        nominal = _nominal(y)
        corner = min(corner, *(_left(t, nominal, t[at], 1) for at in places))
    interval = float(np.median(np.diff(t[: SMOOTHING.border_samples + 1])))
    fading = (np.exp(-t / (lag * interval)) for lag in SMOOTHING.lag_times)
    powers = np.vander(t, 4 if bends else 3)
    lagging = min(_left_by(np.column_stack([powers, decay]), y) for decay in fading)
    return lagging < corner + SMOOTHING.jump_evidence * max(noise, float(np.sqrt(corner / len(t)))) ** 2


def _around(time: FloatArray, first: int, last: int, others: Sequence[int]) -> slice:
    """The samples before `first` and after `last` up to the next jump or end, no more than the widest window."""
    most = SMOOTHING.wider_jump_windows[-1] * _smallest_window(time)
    before = max((other for other in others if other < first), default=0)
    after = min((other for other in others if other > last), default=len(time) - 1)
    return slice(max(before, first - most), min(after, last + most) + 1)


def _agrees(time: FloatArray, values: FloatArray, noise: float, jump: int, corner: int, others: Sequence[int]) -> bool:
    """Whether the strain may as well jump at a corner of the stress as where it seemed to."""
    part = _around(time, min(jump, corner), max(jump, corner), others)
    t, y = time[part] - time[jump], values[part]
    curves = ((y, 1), (y, 2), (_nominal(y), 1))
    there, here = (
        min(_left(t, curve, time[at] - time[jump], degree) for curve, degree in curves) for at in (corner, jump)
    )
    return there - here < (SMOOTHING.stress_corner * noise) ** 2


def _is_jump(time: FloatArray, values: FloatArray, noise: float, corner: int, others: Sequence[int]) -> bool:
    """Whether the slopes of the strain differ at a corner of the stress, more than a smooth bend explains."""
    part = _around(time, corner, corner, others)
    t, y = time[part] - time[corner], values[part]
    hinge = np.column_stack([np.ones_like(t), t, np.maximum(t, 0.0)])
    (_, before, change), left = np.linalg.lstsq(hinge, y, rcond=None)[:2]
    scale = max(float(np.sqrt(left[0] / (len(t) - 3))), noise)
    error = scale * float(np.sqrt(np.linalg.inv(hinge.T @ hinge)[2, 2]))
    smooth = np.polynomial.Polynomial.fit(t, y, 3)
    return bool(
        abs(change) > SMOOTHING.stress_corner * error
        and abs(change) > SMOOTHING.least_jump * max(abs(before), abs(before + change))
        and left[0] < np.sum((y - smooth(t)) ** 2) + (SMOOTHING.stress_corner * scale) ** 2
    )


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
    return _left_by(np.column_stack([np.ones_like(time), *powers]), values)


def _left_by(basis: FloatArray, values: FloatArray) -> float:
    """Sum of squares that a basis leaves."""
    return float(np.sum((values - basis @ np.linalg.lstsq(basis, values, rcond=None)[0]) ** 2))


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
