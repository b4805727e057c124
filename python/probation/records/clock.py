"""Two clocks of one test: by how much a strain file must be shifted to fit the force file, and how well that is known.

The strain of a camera and the crosshead of a machine are tied by the machine's compliance C: L e = u - C F. So the
strain's rate is a sum of the rate of the displacement and of that of the force, the latter not positive, wherever the
two clocks agree; the shift is where that leaves least. A force file without displacement has only its onset: force and
strain leave zero together.

The uncertainty is how far the shift may move until the rest grows by one standard deviation, samples that follow each
other being counted once for as long as the rest remembers itself.
"""

from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from probation.settings.reading import READING

FloatArray = NDArray[np.float64]

_STEPS = 400  # of the grid on which rates are compared, over the shorter record
_SMOOTHED = 4  # steps of the grid that a rate is taken over, either way
_FEWEST = 10  # samples of an onset
_FEWEST_STEPS = 20  # of the grid in the shorter record: fewer tell no shift
_FINE = 20  # shifts in a step of the grid, about the best one


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
        What each leaves unexplained: of the mean square of the strain rate, or of the force up to its onset.
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

    Returns
    -------
    Shift
    """
    if displacement is None:
        return _by_onset(time, force, strain_time, strain)
    shorter = min(float(np.ptp(time)), float(np.ptp(strain_time)))
    step = max(shorter / _STEPS, float(np.median(np.diff(time))), float(np.median(np.diff(strain_time))))
    if shorter < _FEWEST_STEPS * step:
        return Shift(float(time[0] - strain_time[0]), np.inf, "rates of strain, displacement and force", ())
    grid, rate = _rate(strain_time, strain, step)
    known = [_rate(time, values, step) for values in (displacement, -force)]
    lowest = float(time[0] - strain_time[-1]) + READING.clock_overlap * shorter
    highest = float(time[-1] - strain_time[0]) - READING.clock_overlap * shorter
    coarse = np.arange(lowest, highest + step, step)
    rests = np.array([_square(_rest(grid, rate, known, shift)) for shift in coarse])
    best = coarse[int(np.argmin(rests))]
    fine = best + step * np.arange(-2 * _FINE, 2 * _FINE + 1) / _FINE
    fine_rests = np.array([_square(_rest(grid, rate, known, shift)) for shift in fine])
    value = _lowest_of_parabola(fine, fine_rests)
    residual = _rest(grid, rate, known, value)
    se = _reach(np.concatenate([coarse, fine]), np.concatenate([rests, fine_rests]), value, residual)
    at_the_edge = not lowest + step < value < highest - step
    others = _others(coarse, rests, value, 4 * _SMOOTHED * step)
    tried, order = np.unique(np.concatenate([coarse, fine]), return_index=True)
    misfit = np.concatenate([rests, fine_rests])[order] / max(_square(rate), 1e-300)
    unknown = at_the_edge or bool(others) or se > READING.clock_unknown * shorter or not rate.any()
    se = np.inf if unknown else max(se, step / _FINE)
    return Shift(value, se, "rates of strain, displacement and force", others, tried, misfit)


def _others(shifts: FloatArray, rests: FloatArray, value: float, apart: float) -> tuple[float, ...]:
    """Shifts apart from the best one at which the rest is a minimum too, and not much larger."""
    inner = np.flatnonzero((rests[1:-1] <= rests[:-2]) & (rests[1:-1] <= rests[2:])) + 1
    rivals = [at for at in inner if abs(shifts[at] - value) > apart and rests[at] < READING.clock_rival * rests.min()]
    return tuple(float(shifts[at]) for at in sorted(rivals, key=lambda at: float(rests[at]))[:3])


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
    end = max(int(np.argmax(size > READING.clock_onset * size.max())) + 1, _FEWEST)
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
    rested = int((start < best).sum()) >= _FEWEST // 2
    varied = max(_square(signal - signal.mean()), 1e-300)
    return _Onset(best, se if rested else np.inf, candidates, rests / varied)


def _rate(time: FloatArray, values: FloatArray, step: float) -> tuple[FloatArray, FloatArray]:
    """Rate on a grid of that step, over some steps either way; scaled to a mean square of 1."""
    grid = np.arange(time[0], time[-1] + 0.5 * step, step)
    reach = _SMOOTHED * step
    area = np.concatenate([[0.0], np.cumsum(0.5 * (values[1:] + values[:-1]) * np.diff(time))])

    def mean(start: FloatArray, end: FloatArray) -> FloatArray:
        start, end = np.clip(start, time[0], time[-1]), np.clip(end, time[0], time[-1])
        width = np.maximum(end - start, 1e-9 * step)
        whole: FloatArray = (np.interp(end, time, area) - np.interp(start, time, area)) / width
        return whole

    inner = grid[(grid >= time[0] + reach) & (grid <= time[-1] - reach)]
    rate = (mean(inner, inner + reach) - mean(inner - reach, inner)) / reach
    size = float(np.sqrt(np.mean(rate**2))) if len(rate) else 0.0
    return inner, rate / size if size else rate


def _rest(grid: FloatArray, rate: FloatArray, known: list[tuple[FloatArray, FloatArray]], shift: float) -> FloatArray:
    """What the references leave of the strain rate at a shift; a machine that has not started, or ended, rests."""
    columns = np.stack([np.interp(grid + shift, at, values, left=0.0, right=0.0) for at, values in known], axis=1)
    rests = [rate]
    for chosen in ([0, 1], [0]):  # neither the displacement nor the compliance counts negatively
        part = columns[:, chosen]
        coefficients, *_ = np.linalg.lstsq(part, rate, rcond=None)
        if (coefficients >= 0.0).all():
            rests.append(rate - part @ coefficients)
    return min(rests, key=_square)


def _square(values: FloatArray) -> float:
    return float(values @ values)


def _lowest_of_parabola(shifts: FloatArray, rests: FloatArray) -> float:
    at = int(np.argmin(rests))
    if not 0 < at < len(shifts) - 1:
        return float(shifts[at])
    before, here, after = rests[at - 1 : at + 2]
    bend = before - 2.0 * here + after
    offset = 0.5 * (before - after) / bend if bend > 0.0 else 0.0
    return float(shifts[at] + offset * (shifts[1] - shifts[0]))


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
