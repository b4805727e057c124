"""Two clocks of one test: by how much a strain file must be shifted to fit the force file, and how well that is known.

The strain of a camera and the crosshead of a machine are tied by the machine's compliance C: L e = u - C F. That holds
for the strain itself and for its rate. The rates stand out where something happens, so they propose shifts: every one
at which the strain's rate is nearly a sum of the rate of the displacement and of that of the force, the latter not
positive. The strain, which has less noise than its rate, then decides between them, and gives the last digits.

Both files are taken to start at rest: before its first sample a machine stands still, and before a first frame without
strain there is none. So a shift at which the crosshead would move for seconds before the first frame is none.

A force file without displacement has only its onset: force and strain leave zero together.

The uncertainty is how far the shift may move until the rest grows by one standard deviation, samples that follow each
other being counted once for as long as the rest remembers itself; and how close the samples lie.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from probation._arrays import running_integral
from probation.settings.reading import READING

FloatArray = NDArray[np.float64]
Signals = tuple[FloatArray, FloatArray]
"""Times, shape (n,), and what is known then, shape (n,) or (n, k)."""

_STEPS = 400
"""Steps of the grid on which rates are compared, in the shorter record; no step is shorter than a sample's."""
_SMOOTHED = 4
"""Steps of the grid that a rate is taken over, either way: 1 % of the shorter record."""
_KEPT = 1000
"""Means of neighbouring samples, in the shorter record, in which the strain itself is compared: for speed."""
_MOST_PROPOSED = 8
"""Shifts that the rates propose and the strain judges, at most: for speed."""
_FINER, _REFINEMENTS = 5, 4
"""Factor by which the step of the shift falls in each refinement, and how often: to 1/625 of a step of the grid."""
_BY = "strain, displacement and force"


def _nothing() -> FloatArray:
    return np.zeros(0)


@dataclass(frozen=True, eq=False)
class Shift:
    """What is added to the time of the strain file.

    Attributes
    ----------
    value : float [s]
    se : float [s]
        Standard error; infinite where the records do not tell.
    by : str
        How it was found, for people.
    others : tuple of float [s]
        Shifts elsewhere that fit nearly as well; where there are any, the records do not tell.
    tried : ndarray, shape (n,) [s]
        Shifts that were tried, in increasing order; empty of a shift that was stated.
    misfit : ndarray, shape (n,) [-]
        What each leaves unexplained: of the mean square of the strain, or of the force up to its onset.
    """

    value: float
    se: float
    by: str
    others: tuple[float, ...] = ()
    tried: FloatArray = field(default_factory=_nothing)
    misfit: FloatArray = field(default_factory=_nothing)


def estimate_shift(
    time: FloatArray, force: FloatArray, displacement: FloatArray | None, strain_time: FloatArray, strain: FloatArray
) -> Shift:
    """Find the shift between a force file and a strain file.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
        Of the force file.
    force : ndarray, shape (n,)
        Force or stress, any unit.
    displacement : ndarray, shape (n,), or None
        Displacement or strain of the force file, any unit.
    strain_time : ndarray, shape (m,) [s]
        Of the strain file.
    strain : ndarray, shape (m,) [-]
    """
    if displacement is None:
        return _by_onset(time, force, strain_time, strain)
    shorter = min(float(np.ptp(time)), float(np.ptp(strain_time)))
    apart = max(float(np.median(np.diff(time))), float(np.median(np.diff(strain_time))))
    step = max(shorter / _STEPS, apart)
    if shorter < READING.clock_steps * step or not np.ptp(strain):
        return Shift(float(time[0] - strain_time[0]), np.inf, _BY, ())
    machine, film = (time, np.stack([displacement, -force], axis=1)), (strain_time, strain)
    lowest = float(time[0] - strain_time[-1]) + READING.clock_overlap * shorter
    highest = float(time[-1] - strain_time[0]) - READING.clock_overlap * shorter
    shifts = np.arange(lowest, highest + step, step)
    tie = _Tie(machine, film, shorter / _KEPT)
    minima = [
        minimum
        for proposed in _proposed(machine, film, shifts, step)
        if (minimum := tie.minimum(proposed, _SMOOTHED * step)) is not None
    ]
    value = tie.best()
    variance = tie.variance(value)
    reach = max(tie.reach(value, away * step, variance, (lowest, highest)) for away in (-1.0, 1.0))
    rests = tie.rests()
    elsewhere = {at for at in minima if abs(at - value) > 4 * _SMOOTHED * step}
    others = sorted(
        (at for at in elsewhere if rests[at] < rests[value] + READING.clock_rival * variance),
        key=rests.__getitem__,
    )
    se = float(np.hypot(max(reach, step * _FINER**-_REFINEMENTS), READING.clock_between * apart))
    at_the_edge = not lowest + step < value < highest - step
    unknown = at_the_edge or bool(others) or se > READING.clock_unknown * shorter
    tried = np.unique(np.append(shifts, value))
    return Shift(value, np.inf if unknown else se, _BY, tuple(others[:3]), tried, tie.misfits(tried))


def _proposed(machine: Signals, film: Signals, shifts: FloatArray, step: float) -> list[float]:
    """Shifts at which the rates leave a minimum that is not much larger than the least, the least first."""
    reach = _SMOOTHED * step
    start, end = float(film[0][0]), float(machine[0][-1])
    early = max(float(shifts[-1]) - float(machine[0][0]) + start, 0.0) + 3.0 * reach
    grid, rate = _rate(_rested(film, early) if _starts_at_rest(film) else film, step)
    known = _rate(_rested(machine, 3.0 * reach), step)
    sums, frames = np.empty(len(shifts)), np.empty(len(shifts))
    for i, shift in enumerate(shifts):
        both = (grid + shift <= end) & (grid + shift >= min(float(machine[0][0]), start + shift) - reach)
        sums[i] = _square(_rest(_at(known, grid[both] + shift), rate[both]))
        frames[i] = (grid[both] >= start).sum()
    rests = _filled(sums, frames, float((grid >= start).sum()))
    inner = np.flatnonzero((rests[1:-1] <= rests[:-2]) & (rests[1:-1] <= rests[2:])) + 1
    proposed: list[float] = []
    for i in sorted([*inner.tolist(), int(np.argmin(rests))], key=rests.__getitem__):
        if rests[i] < READING.clock_proposed * rests.min() and all(
            abs(shifts[i] - other) > reach for other in proposed
        ):
            proposed.append(float(shifts[i]))
    return proposed[:_MOST_PROPOSED]


class _Tie:
    """What displacement and force leave of the strain itself, at every shift that was tried."""

    def __init__(self, machine: Signals, film: Signals, step: float) -> None:
        self.machine = _thinned(_rested(machine, step), step)
        self.film = _thinned(film, step)
        self.start, self.spacing = float(film[0][0]), float(np.median(np.diff(self.film[0])))
        self.rested = _starts_at_rest(film)
        self.tried: dict[float, tuple[float, int]] = {}

    def minimum(self, proposed: float, reach: float) -> float | None:
        """The shift near a proposed one that leaves least; None where the rest only falls towards another place."""
        around = proposed + 0.5 * reach * np.arange(-8.0, 9.0)
        width, best = 0.5 * reach, self._least(around)
        if best in (around[0], around[-1]):
            return None
        for _ in range(_REFINEMENTS):
            width /= _FINER
            best = self._least(best + width * np.arange(-2.0 * _FINER, 2.0 * _FINER + 1.0))
        return best

    def best(self) -> float:
        rests = self.rests()
        return min(rests, key=rests.__getitem__)

    def rests(self) -> dict[float, float]:
        sums, frames = np.array(list(self.tried.values())).T
        return dict(zip(self.tried, map(float, _filled(sums, frames, len(self.film[0]))), strict=True))

    def variance(self, shift: float) -> float:
        """Of the sum of squares that is left at a shift, if it were noise that remembers itself as this does."""
        residual, frames = self._residual(shift)
        left = residual[:frames]
        exact = READING.clock_exact * float(np.abs(self.film[1]).max())
        return max(_square(left) / max(frames - 4, 1) * _memory(left), exact**2)

    def reach(self, value: float, step: float, variance: float, within: tuple[float, float]) -> float:
        """How far the shift may move that way until the rest grows by its variance."""
        rests = self.rests()
        limit = rests[value] + variance
        reach = max(abs(at - value) for at, rest in rests.items() if rest <= limit and (at - value) * step >= 0.0)
        while within[0] < value + np.copysign(reach, step) + step < within[1]:
            at = value + float(np.copysign(reach, step)) + step
            self._least(np.array([at]))
            if self.rests()[at] > limit:
                break
            reach = abs(at - value)
        return reach

    def misfits(self, shifts: FloatArray) -> FloatArray:
        """What each shift leaves of the mean square of the strain."""
        left = [self._residual(shift) for shift in map(float, shifts)]
        sums, frames = np.array([(_square(residual), count) for residual, count in left]).T
        strain = self.film[1]
        misfits: FloatArray = _filled(sums, frames, len(strain)) / max(_square(strain - strain.mean()), 1e-300)
        return misfits

    def _least(self, shifts: FloatArray) -> float:
        for shift in map(float, shifts):
            if shift not in self.tried:
                residual, frames = self._residual(shift)
                self.tried[shift] = (_square(residual), frames)
        rests = self.rests()
        return min(map(float, shifts), key=rests.__getitem__)

    def _residual(self, shift: float) -> tuple[FloatArray, int]:
        """What is left of the frames within the force file, then of no strain before the film; how many frames."""
        (frames, strain), first = self.film, self.start + shift
        within = frames + shift <= self.machine[0][-1]
        before = np.arange(first - self.spacing, self.machine[0][0], -self.spacing) if self.rested else np.empty(0)
        columns = _at(self.machine, np.concatenate([frames[within] + shift, before]))
        count = int(within.sum())
        columns[count:] -= _at(self.machine, np.array([first]))
        offset = (np.arange(len(columns)) < count).astype(float)[:, np.newaxis]
        return _rest(columns, np.concatenate([strain[within], np.zeros(len(before))]), offset), count


def _filled(sums: FloatArray, frames: FloatArray, of: float) -> FloatArray:
    """Sums of squares as if all frames were in common: those that are not are left as well as at the best shift."""
    filled: FloatArray = sums + (of - frames) * np.min(sums / np.maximum(frames, 1.0))
    return filled


def _starts_at_rest(film: Signals) -> bool:
    return bool(abs(film[1][0]) < READING.clock_unstrained * np.abs(film[1]).max())


def _rested(signals: Signals, before: float) -> Signals:
    """With a rest of that duration [s] before the first sample."""
    time, values = signals
    rest = np.array([time[0] - before, time[0] - 1e-9 * before])
    return np.concatenate([rest, time]), np.concatenate([values[:1], values[:1], values])


def _thinned(signals: Signals, step: float) -> Signals:
    """Means of neighbouring samples over about a step."""
    time, values = signals
    together = max(int(step / float(np.median(np.diff(time)))), 1)
    starts = np.arange(0, len(time) - together + 1, together)
    count = float(together)
    stop = starts[-1] + together
    return (
        np.add.reduceat(time[:stop], starts) / count,
        np.add.reduceat(values[:stop], starts, axis=0) / count,
    )


def _at(signals: Signals, times: FloatArray) -> FloatArray:
    """Every column at these times, shape (len(times), k)."""
    return np.stack([np.interp(times, signals[0], column) for column in signals[1].T], axis=1)


def _reach(candidates: FloatArray, rests: FloatArray, value: float, residual: FloatArray) -> float:
    """How far from the best value the rest stays within one standard deviation of its least."""
    least = float(residual @ residual)
    variance = least / max(len(residual) - 3, 1) * _memory(residual)
    near = candidates[rests < max(least, float(rests.min())) + variance]
    return float(np.abs(near - value).max()) if near.size else 0.0


def _by_onset(time: FloatArray, force: FloatArray, strain_time: FloatArray, strain: FloatArray) -> Shift:
    of_force, of_strain = _onset(time, force), _onset(strain_time, strain)
    se = float(np.hypot(of_force.se, of_strain.se))
    tried = of_force.tried - of_strain.time
    return Shift(of_force.time - of_strain.time, se, "onset of force and of strain", (), tried, of_force.misfit)


class _Onset(NamedTuple):
    """When a signal leaves its rest [s], the standard error of that, infinite where no rest was recorded.

    And the instants that were tried, and what part of the signal's mean square each leaves.
    """

    time: float
    se: float
    tried: FloatArray
    misfit: FloatArray


def _onset(time: FloatArray, values: FloatArray) -> _Onset:
    """Find when a signal leaves its rest."""
    size = np.abs(values - np.median(values[: max(len(values) // 50, 3)]))
    end = max(int(np.argmax(size > READING.clock_onset * size.max())) + 1, READING.clock_onset_samples)
    start, signal = time[:end], values[:end]
    step = max(float(np.ptp(start)) / _STEPS, 1e-12)
    candidates = np.arange(start[0], start[-1] - 2.0 * step, step)

    def rest(at: float) -> FloatArray:
        later = np.maximum(start - at, 0.0)
        columns = np.stack([np.ones_like(start), later, later**2], axis=1)
        coefficients, *_ = np.linalg.lstsq(columns, signal, rcond=None)
        residual: FloatArray = signal - columns @ coefficients
        return residual

    rests = np.array([float(np.square(rest(at)).sum()) for at in candidates])
    best = float(candidates[int(np.argmin(rests))])
    se = max(_reach(candidates, rests, best, rest(best)), step, float(np.median(np.diff(start))) / 4.0)
    rested = int((start < best).sum()) >= READING.clock_onset_samples // 2
    varied = max(_square(signal - signal.mean()), 1e-300)
    return _Onset(best, se if rested else np.inf, candidates, rests / varied)


def _rate(signals: Signals, step: float) -> Signals:
    """Rates on a grid of that step, over some steps either way; each scaled to a mean square of 1."""
    time, values = signals
    grid = np.arange(time[0], time[-1] + 0.5 * step, step)
    reach = _SMOOTHED * step
    inner = grid[(grid >= time[0] + reach) & (grid <= time[-1] - reach)]

    def of(column: FloatArray) -> FloatArray:
        area = running_integral(column, time)
        areas = [np.interp(inner + at, time, area) for at in (-reach, 0.0, reach)]
        rate: FloatArray = (areas[0] - 2.0 * areas[1] + areas[2]) / reach**2
        size = float(np.sqrt(np.mean(rate**2))) if len(rate) else 0.0
        return rate / size if size else rate

    return inner, of(values) if values.ndim == 1 else np.stack([of(column) for column in values.T], axis=1)


def _rest(columns: FloatArray, values: FloatArray, free: FloatArray | None = None) -> FloatArray:
    """What is left of values; neither the displacement nor the compliance counts negatively, the free column may."""
    rests = []
    for chosen in ([0, 1], [0], []):
        part = columns[:, chosen] if free is None else np.hstack([columns[:, chosen], free])
        size = np.sqrt(np.maximum(np.square(part).sum(axis=0), 1e-300))
        coefficients, *_ = np.linalg.lstsq(part / size, values, rcond=None)
        if (coefficients[: len(chosen)] >= 0.0).all():
            rests.append(values - part / size @ coefficients)
    return min(rests, key=_square)


def _square(values: FloatArray) -> float:
    return float(values @ values)


def _memory(residual: FloatArray) -> float:
    """Integrated autocorrelation time [samples], summed until it first falls below zero."""
    power = float(residual @ residual)
    if power == 0.0:
        return 1.0
    memory = 1.0
    for lag in range(1, len(residual) // 2):
        correlation = float(residual[lag:] @ residual[:-lag]) / power
        if correlation <= 0.0:
            break
        memory += 2.0 * correlation
    return memory
