"""A record smoothed segment by segment between its jumps."""

from __future__ import annotations

from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.smoothing import SMOOTHING
from probation.smoothing.operators import Operators
from probation.smoothing.rate_change import RateChange
from probation.smoothing.smoothed import Smoothed, Smoother, polynomial

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.smoothing.smoothed import LaggingSmoother


def smooth_segments(
    smoother: Smoother,
    time: FloatArray,
    true_strain: FloatArray,
    jumps: Sequence[int],
    noise: float,
    *,
    lagging: LaggingSmoother | None = None,
    averaged: float | None = None,
) -> Smoothed:
    """Smooth each segment by itself.

    A jump lies near a sample, not at it: that sample would pollute the end of the segment that it does not belong to,
    and is left out of both if they are long enough. There, the strain is the mean of the sample and of what both sides
    come to, each by its inverse variance: one side errs by up to the change of the rate over one interval, too. The
    rate is that of the side before.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    jumps : sequence of int
        Indices at which the rate is discontinuous; increasing, without the ends.
    noise : float
        Standard deviation of the strain noise [-].
    lagging : LaggingSmoother, optional
        In place of `smoother` where the strain may lag behind its command at the start of a segment.
    averaged : float, optional
        Inflation of the noise's variance in slow averages, as the records of the same extensometer show it together;
        for a lagging smoother, which else seeks it in each segment.
    """
    if lagging is not None:
        smoother = lagging = partial(lagging, averaged=averaged)
    borders = [0, *jumps, len(time) - 1]
    segments = [_Segment.of(smoother, time, true_strain, borders, at, lagging) for at in range(len(borders) - 1)]
    parts = [segment.smoothed for segment in segments]
    strain, rate = np.empty_like(time), np.empty_like(time)
    strain_error, rate_error = np.empty_like(time), np.empty_like(time)
    for (first, last), part in zip(pairwise(borders), parts, strict=True):
        keep = slice(first + (first > 0), last + 1)
        own = slice(keep.start - first, None)
        strain[keep], rate[keep] = part.true_strain[own], part.strain_rate[own]
        strain_error[keep], rate_error[keep] = part.strain_error[own], part.rate_error[own]
    shares: list[FloatArray] = []
    corners: list[Operators] = []
    for jump, before, after in zip(jumps, parts, parts[1:], strict=False):
        bend = (after.strain_rate[0] - before.strain_rate[-1]) * (time[jump + 1] - time[jump - 1]) / 2.0
        # The jump is before the sample or after it, by up to an interval: each side is right half of the time.
        astray = bend**2 / 6.0 / max(noise, SMOOTHING.clean) ** 2
        errors = np.array([before.strain_error[-1], after.strain_error[0], 1.0])
        precision = 1.0 / (errors**2 + astray * np.array([1.0, 1.0, 0.0]))
        share = precision / precision.sum()
        strain[jump] = float(share @ [before.true_strain[-1], after.true_strain[0], true_strain[jump]])
        strain_error[jump] = float(precision.sum() ** -0.5)
        shares.append(share)
        change = after.strain_rate[0] - before.strain_rate[-1]
        corner = _uncertain_corner(time, jump, change, max(noise, SMOOTHING.clean))
        strain_error = np.hypot(strain_error, np.linalg.norm(corner.strain, axis=1))
        rate_error = np.hypot(rate_error, np.linalg.norm(corner.rate, axis=1))
        corners.append(corner)
    used = float(sum(segment.used for segment in segments))
    return Smoothed(
        strain,
        rate,
        strain_error,
        rate_error,
        float(sum(part.freedom for part in parts)) + len(time) - used,
        float(sum(part.squares for part in parts)),
        float(sum(segment.used * segment.smoothed.inflation for segment in segments)) / used,
        partial(_operators, segments, borders, shares),
        partial(_errors, segments, borders, shares, corners),
    )


def _uncertain_corner(time: FloatArray, jump: int, change: float, noise: float) -> Operators:
    """What is not known of where the rate changes, and how fast: the strain lags before the jump, or after it.

    A deviation from the corner that begins so much earlier, or ends so much later, as the samples just do not show: a
    triangle of height h over h/b of them, b the bend over one interval, has a squared size of h^3/3b, in units of the
    noise. Higher than the noise of one sample it is not: the sample at the jump would show it.
    """
    since = time - time[jump]
    bend = abs(change) * (time[jump + 1] - time[jump - 1]) / (2.0 * noise)
    if bend == 0.0:
        return Operators(np.zeros((len(time), 2)), np.zeros((len(time), 2)))
    height = min((3.0 * bend) ** (1.0 / 3.0), 1.0)
    reach = height * noise / abs(change)
    inside = np.column_stack([(-reach < since) & (since <= 0.0), (since > 0.0) & (since < reach)])
    strain = np.where(inside, height * (1.0 - np.abs(since)[:, None] / reach), 0.0)
    rate = np.where(inside, np.array([1.0, -1.0]) * height / reach, 0.0)
    return Operators(strain, rate)


class _Segment:
    """One segment, at all samples from jump to jump, with the columns of the samples that it was made of."""

    def __init__(self, smoothed: Smoothed, used: int) -> None:
        self.smoothed, self.used = smoothed, used

    @classmethod
    def of(
        cls,
        smoother: Smoother,
        time: FloatArray,
        true_strain: FloatArray,
        borders: Sequence[int],
        at: int,
        lagging: LaggingSmoother | None,
    ) -> _Segment:
        first, last = borders[at], borders[at + 1]
        lengths = np.diff(borders)

        def left_out(inner: int) -> bool:
            return 0 < inner < len(borders) - 1 and min(lengths[inner - 1], lengths[inner]) > SMOOTHING.without_jump

        skip, drop = int(left_out(at)), int(left_out(at + 1))
        whole = time[first : last + 1]
        inside = slice(skip, len(whole) - drop)
        values = true_strain[first : last + 1][inside]
        few = len(values) < SMOOTHING.shortest_curve
        if lagging is not None and len(values) > SMOOTHING.border_samples:
            begins = RateChange.of(time, true_strain, first, borders[at - 1] if at else first, last)
            smoother = partial(lagging, begins=begins)
        smoothed = polynomial(whole[inside], values, 1) if few else smoother(whole[inside], values)
        return cls(_extended(smoothed, whole, skip, drop), len(values))


def _extended(part: Smoothed, time: FloatArray, skip: int, drop: int) -> Smoothed:
    """The same one sample further at either end, by a parabola."""
    if not skip and not drop:
        return part
    count = len(part.true_strain)
    rows = np.arange(count)

    def grow(strain: FloatArray, rate: FloatArray) -> tuple[FloatArray, FloatArray]:
        strains, rates = [strain], [rate]
        if skip:
            begin, slope = _beyond(time[1:3], strain[:2], rate[:2], time[0])
            strains.insert(0, begin)
            rates.insert(0, slope)
        if drop:
            end, slope = _beyond(time[-3:-1][::-1], strain[-2:][::-1], rate[-2:][::-1], time[-1])
            strains.append(end)
            rates.append(slope)
        return np.concatenate(strains), np.concatenate(rates)

    def operators() -> Operators:
        made = part.operators()
        strain, rate = grow(made.strain, made.rate)
        margins = ((0, 0), (skip, drop))
        return Operators(np.pad(strain, margins), np.pad(rate, margins))

    def errors() -> Operators:
        made = (part.errors or part.operators)()
        return Operators(*grow(made.strain, made.rate))

    strain, rate = grow(part.true_strain, part.strain_rate)
    nearest = np.concatenate([rows[:1]] * skip + [rows] + [rows[-1:]] * drop)
    step = np.zeros(len(nearest))
    step[0] += skip * (time[1] - time[0])
    step[-1] += drop * (time[-1] - time[-2])
    return Smoothed(
        strain,
        rate,
        part.strain_error[nearest] + step * part.rate_error[nearest],
        part.rate_error[nearest],
        part.freedom,
        part.squares,
        part.inflation,
        operators,
        errors,
    )


def _beyond(time: FloatArray, strain: FloatArray, rate: FloatArray, at: float) -> tuple[FloatArray, FloatArray]:
    """Strain and rate at `at`, beyond the first of two samples; linear in both, as arrays with a first axis of 1."""
    ahead = at - time[0]
    bend = (rate[1:2] - rate[:1]) / (time[1] - time[0])
    return strain[:1] + ahead * rate[:1] + 0.5 * ahead**2 * bend, rate[:1] + ahead * bend


def _operators(segments: Sequence[_Segment], borders: Sequence[int], shares: Sequence[FloatArray]) -> Operators:
    """Of the samples: blocks along the diagonal; neighbours share the sample at the jump."""
    columns = [slice(first, last + 1) for first, last in pairwise(borders)]
    made = [segment.smoothed.operators() for segment in segments]
    return _joined(made, columns, borders[1:-1], borders[-1] + 1, borders, shares)


def _errors(
    segments: Sequence[_Segment], borders: Sequence[int], shares: Sequence[FloatArray], corners: Sequence[Operators]
) -> Operators:
    """Of independent errors: those of the segments, of the samples at the jumps, and of what happens between these."""
    made = [(segment.smoothed.errors or segment.smoothed.operators)() for segment in segments]
    ends = np.cumsum([0, *(part.strain.shape[1] for part in made)]).tolist()
    columns = [slice(first, last) for first, last in pairwise(ends)]
    joined = _joined(made, columns, range(ends[-1], ends[-1] + len(shares)), ends[-1] + len(shares), borders, shares)
    return Operators(
        np.hstack([joined.strain, *(corner.strain for corner in corners)]),
        np.hstack([joined.rate, *(corner.rate for corner in corners)]),
    )


def _joined(
    parts: Sequence[Operators],
    columns: Sequence[slice],
    at_jumps: Sequence[int],
    count: int,
    borders: Sequence[int],
    shares: Sequence[FloatArray],
) -> Operators:
    """Each segment in its columns of `count`, the sample at each jump in its own; there, the shares of all three."""
    strain, rate = np.zeros((borders[-1] + 1, count)), np.zeros((borders[-1] + 1, count))
    for at, (made, own, (first, last)) in enumerate(zip(parts, columns, pairwise(borders), strict=True)):
        rows = made.strain.copy()
        if at > 0:
            rows[0] *= shares[at - 1][1]
        if at < len(shares):
            rows[-1] *= shares[at][0]
            strain[last, at_jumps[at]] += shares[at][2]
        strain[first : last + 1, own] += rows
        skip = int(first > 0)
        rate[first + skip : last + 1, own] = made.rate[skip:]
    return Operators(strain, rate)
