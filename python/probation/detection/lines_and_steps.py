"""Gaps that are sharp in one way: a line of one frequency, a step at one instant."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from probation.detection.tail import family_p_value, normal_tail, smallest_of_many, student_tail
from probation.noise.smooth_basis import smooth_basis
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.noise.whitening import Whitened


ROUNDING = 1e-10
"""Variance [-] of a unit filter that is added to its own: filters of neighbouring instants are nearly one."""

KEPT = 32
"""Bases of slow waves that are kept; a record has one for lines and one for steps."""


@dataclass(frozen=True)
class Line:
    """The strongest line of a record's periodogram.

    Attributes
    ----------
    record : str
    frequency_Hz : float
    amplitude_MPa : float
    p_value : float
        Over all frequencies of all records.
    """

    record: str
    frequency_Hz: float  # noqa: N815
    amplitude_MPa: float  # noqa: N815
    p_value: float


@dataclass(frozen=True)
class Step:
    """The strongest step of a record.

    Attributes
    ----------
    record : str
    time_s, true_strain : float
        Of the first sample after it.
    size_MPa : float
        Of the model minus the data: a step up of the data is negative.
    p_value : float
        Over all instants of all records.
    """

    record: str
    time_s: float
    true_strain: float
    size_MPa: float  # noqa: N815
    p_value: float


def find_lines(whitened: Whitened) -> tuple[Line, ...]:
    """The strongest periodic part of every record, by p-value (docs/diagnosis-method.md, section 3).

    The periodogram of the whitened residual, slow waves and the record's own refit projected out, against the noise
    model or the power of the neighbouring frequencies, whichever is larger. That is also taken as it was before
    whitening divided it by the spectrum of the moving average: where this is next to nothing, at the highest frequency,
    whitening makes a line of any noise that the model lacks. Frequencies are tried at twice the natural spacing, which
    counts as twice as many independent ones (Scargle 1982; an upper bound).

    Parameters
    ----------
    whitened : Whitened
    """
    lines = []
    for index, record in enumerate(whitened.records):
        count = len(record)
        if count < DETECTION.fewest_for_lines * DETECTION.slowest_line:
            continue
        left, white = left_by_slow_waves(whitened, index, DETECTION.slowest_line)
        duration = float(record.time[-1] - record.time[0]) * count / (count - 1)
        # By sample: where samples are uneven, so is their phase; the exact sums are then taken in time.
        frequency = np.arange(
            DETECTION.oversampling * DETECTION.slowest_line // 2, DETECTION.oversampling * count // 2
        ) / (DETECTION.oversampling * duration)
        columns = np.column_stack([left, speed_wander_in(whitened, index, white)])
        powers = _power(record.time, columns, frequency, duration)
        power = powers[:, 0]
        undone = whitened.noises[index].arma.moving_average(2.0 * np.pi * frequency * duration / count)
        around, before = (running_median(each, DETECTION.line_neighbours) for each in (power, power * undone))
        level = np.maximum(np.maximum(around, before / undone) / np.log(2.0), 1.0)
        level += powers[:, 1:].sum(axis=1)
        best = int(np.argmax(power / level))
        single = float(np.exp(-power[best] / level[best]))
        tried = len(power) * len(whitened.records)
        _, parts = fitted_waves(whitened, index, left, white, 2.0 * np.pi * frequency[best] * record.time[:, None])
        p_value = smallest_of_many(single, tried)
        lines.append(Line(record.name, float(frequency[best]), float(np.hypot(*parts)), p_value))
    return tuple(sorted(lines, key=lambda line: line.p_value))


def fitted_waves(
    whitened: Whitened,
    index: int,
    left: FloatArray,
    white: FloatArray,
    phases: FloatArray,
    growth: FloatArray | None = None,
) -> tuple[FloatArray, FloatArray]:
    """Cosines and sines of phases (n, m) over a record, shape (n, 2 m), and their sizes [MPa], shape (2 m,).

    By least squares of what `left_by_slow_waves` leaves, with the columns that it takes out. With a `growth` (n,) as
    many more follow, in proportion to it.
    """
    waves = np.hstack([np.cos(phases), np.sin(phases)])
    if growth is not None:
        waves = np.hstack([waves, waves * growth[:, None]])
    seen = whitened.noises[index].whiten(waves)
    size = np.linalg.lstsq(seen - white @ (white.T @ seen), left, rcond=None)[0]
    return waves, np.asarray(size, dtype=np.float64)


def find_steps(whitened: Whitened, *, size: int = DETECTION.step_draws, seed: int = 0) -> tuple[Step, ...]:
    """The strongest step of every record by a matched filter, by p-value (docs/diagnosis-method.md, section 3).

    What a step leaves after slow waves, fades and the record's own refit are projected out is compared with what the
    residual leaves, for steps that stay and for such from which the stress recovers; the largest score is held against
    draws of the largest score under the null.

    Parameters
    ----------
    whitened : Whitened
    size : int
        Draws.
    seed : int
    """
    strongest = []
    for index, filters in enumerate(_step_filters(whitened.records, whitened.noises, size, seed)):
        if filters is None:
            continue
        record = whitened.records[index]
        found = _strongest_step(whitened, index, filters)
        # The finer instants that only the best place is given: each is nearly one of the coarse ones.
        family = float(family_p_value(found.single, filters.drawn))
        p_value = smallest_of_many(family, len(whitened.records))
        time, strain = float(record.time[found.place]), float(record.true_strain[found.place])
        strongest.append(Step(record.name, time, strain, found.size, p_value))
    return tuple(sorted(strongest, key=lambda step: step.p_value))


def without_steps(whitened: Whitened, level: float) -> dict[int, RecordResidual]:
    """Records without their strongest steps, where these have a p-value below a level among all that were tried."""
    taken = {}
    for index, record in enumerate(whitened.records):
        filters = _step_filters_of(record, whitened.noises[index])
        if filters is None:
            continue
        found = _strongest_step(whitened, index, filters)
        if smallest_of_many(found.single, filters.steps.shape[1] * len(whitened.records)) < level:
            step = _recovering(len(record), np.array([found.place]), found.recovery)[:, 0]
            taken[index] = replace(record, residual=record.residual - found.size * step)
    return taken


class _Found(NamedTuple):
    """The strongest step of one record.

    Attributes
    ----------
    place : int
        The first sample after it.
    recovery : float
        Part of the record in which the stress recovers from it.
    size : float
        Of the model minus the data [MPa].
    single : float
        Its p-value, were it the only one that was tried.
    """

    place: int
    recovery: float
    size: float
    single: float


def _strongest_step(whitened: Whitened, index: int, filters: _StepFilters) -> _Found:
    """The best of the filters, and around it the best instant; the noise there is what the step itself leaves."""
    record = whitened.records[index]
    left, white = left_by_slow_waves(whitened, index, None)
    coarse = int(np.argmax(np.abs(filters.steps.T @ left)))
    recovery, best = filters.recoveries[coarse], int(filters.instants[coarse])
    near = np.arange(max(best - filters.stride, 3), min(best + filters.stride + 1, len(record) - 2))
    fine, norm = _steps(record, whitened.noises[index], white, near, recovery)
    at = int(np.argmax(np.abs(fine.T @ left)))
    along, place = float(fine[:, at] @ left), int(near[at])
    rest = left - along * fine[:, at]
    score = along / _local_noise_sd(rest, place) / _spread_by_wander(whitened, index, white, fine[:, at])
    single = max(float(normal_tail(abs(score), filters.spread)), float(student_tail(abs(score), _freedom(rest))))
    return _Found(place, recovery, along / float(norm[at]), single)


@dataclass(frozen=True, eq=False)
class _StepFilters:
    """Filters for a step in one record, and what they find in noise.

    Attributes
    ----------
    instants : ndarray, shape (m,)
        Samples before which a step is tried, `stride` apart.
    recoveries : ndarray, shape (m,)
        Part of the record in which the stress recovers from it.
    stride : int
    steps : ndarray, shape (n, m)
        Whitened, projected and normalised.
    spread : float
        Standard deviation of the logarithm of the noise's size.
    drawn : ndarray, shape (size,)
        P-values of the largest score in draws of the noise; none until these are asked for.
    """

    instants: NDArray[np.intp]
    recoveries: FloatArray
    stride: int
    steps: FloatArray
    spread: float
    drawn: FloatArray


@lru_cache(maxsize=2)
def _step_filters(
    records: tuple[RecordResidual, ...], noises: tuple[NoiseModel, ...], size: int, seed: int
) -> tuple[_StepFilters | None, ...]:
    """Of every record, None where it is too short; kept, since many explanations are tried on the same records."""
    rng = np.random.default_rng(seed)
    found: list[_StepFilters | None] = []
    for record, noise in zip(records, noises, strict=True):
        filters = _step_filters_of(record, noise)
        if filters is not None:
            along = filters.steps.T @ filters.steps
            root = np.linalg.cholesky(along + ROUNDING * np.eye(len(along)))
            drawn = np.max(np.abs(rng.standard_normal((size, len(along))) @ root.T), axis=1)
            drawn *= np.exp(filters.spread * rng.standard_normal(size))
            filters = replace(filters, drawn=normal_tail(drawn, filters.spread))
        found.append(filters)
    return tuple(found)


def _step_filters_of(record: RecordResidual, noise: NoiseModel) -> _StepFilters | None:
    """Of one record, without draws of the noise; None where it is too short."""
    count = len(record)
    if count < DETECTION.fewest_for_steps * DETECTION.slowest_line:
        return None
    stride = -(-count // DETECTION.step_candidates)
    instants = np.arange(max(stride, 3), count - 2, stride)
    white = _slow_waves(record, noise, None)
    steps = [_steps(record, noise, white, instants, recovery)[0] for recovery in DETECTION.step_recoveries]
    kinds = len(DETECTION.step_recoveries)
    spread = 0.5 * float(np.sqrt(noise.level_variance + noise.shape_variance))
    recoveries = np.repeat(DETECTION.step_recoveries, len(instants))
    return _StepFilters(np.tile(instants, kinds), recoveries, stride, np.hstack(steps), spread, np.ones(0))


def _local_noise_sd(rest: FloatArray, place: int) -> float:
    """Size of what a step leaves around its instant, over the usual one; not below 1.

    The noise model may have missed a burst; a step is looked for with short windows, and would find it.
    """
    size = 1.0
    for reach in DETECTION.step_neighbours:
        near = np.concatenate([rest[max(place - reach, 0) : max(place - 1, 0)], rest[place + 2 : place + reach]])
        if near.size > reach:
            size = max(size, float(np.sqrt(np.mean(near**2))))
    return size


def _spread_by_wander(whitened: Whitened, index: int, white: FloatArray, direction: FloatArray) -> float:
    """Standard deviation along a unit direction where the speed may wander, at the frequency that is most like it."""
    along = direction @ speed_wander_in(whitened, index, white)
    return float(np.sqrt(1.0 + np.max(np.sum(along.reshape(2, -1) ** 2, axis=0), initial=0.0)))


def _freedom(values: FloatArray) -> float:
    """Degrees of freedom of the Student t that has the kurtosis of sums over a few neighbours; infinite if normal."""
    count = len(values) // DETECTION.burst_samples
    sums = values[: count * DETECTION.burst_samples].reshape(count, DETECTION.burst_samples).sum(axis=1)
    variance = float(np.mean(sums**2))
    if count < DETECTION.burst_samples or variance == 0.0:
        return np.inf
    excess = float(np.mean(sums**4)) / variance**2 - 3.0
    return 4.0 + 6.0 / excess if excess > 0.0 else np.inf


def left_by_slow_waves(whitened: Whitened, index: int, waves: int | None) -> tuple[FloatArray, FloatArray]:
    """Whitened residual of a record without slow waves and its own refit, and the orthonormal columns taken out."""
    white = _slow_waves(whitened.records[index], whitened.noises[index], waves)
    residual = whitened.residual[whitened.slices[index]]
    return residual - white @ (white.T @ residual), white


@lru_cache(maxsize=KEPT)
def _slow_waves(record: RecordResidual, noise: NoiseModel, waves: int | None) -> FloatArray:
    """Orthonormal basis of a record's slow waves and its own refit, whitened, shape (n, k)."""
    smooth = smooth_basis(record.time, () if waves else record.jumps, waves or DETECTION.slowest_line)
    columns = noise.whiten(np.hstack([smooth.columns, record.tangent]))
    size = np.linalg.norm(columns, axis=0)
    left, upper = np.linalg.qr(columns / np.where(size > 0.0, size, 1.0))
    turned, singular, _ = np.linalg.svd(upper)
    return np.asarray(left @ turned[:, singular > 1e-8 * singular[0]])


def speed_wander_in(whitened: Whitened, index: int, white: FloatArray) -> FloatArray:
    """Whitened columns of a record's hidden wander of the speed, without what `white` spans; shape (n, k).

    The cosines, then the sines, of the frequencies at which it is no small part of the noise.
    """
    record = whitened.records[index]
    if record.wander is None:
        return np.zeros((len(record), 0))
    columns = whitened.noises[index].whiten(record.wander)
    columns = columns - white @ (white.T @ columns)
    seen = np.sum(columns.reshape(len(columns), 2, -1) ** 2, axis=(0, 1)) > DETECTION.negligible_wander
    return np.asarray(columns[:, np.tile(seen, 2)])


def _steps(
    record: RecordResidual, noise: NoiseModel, white: FloatArray, instants: NDArray[np.intp], recovery: float
) -> tuple[FloatArray, FloatArray]:
    """Unit steps at the instants, whitened and projected, normalised; and their norms."""
    columns = noise.whiten(_recovering(len(record), instants, recovery))
    columns = columns - white @ (white.T @ columns)
    norm = np.maximum(np.linalg.norm(columns, axis=0), 1e-300)
    return columns / norm, norm


def _recovering(count: int, instants: NDArray[np.intp], recovery: float) -> FloatArray:
    """Unit steps at the instants, less by a factor of e after every such part of the record, shape (count, m)."""
    from_zero = np.append(np.zeros(count), np.exp(-np.arange(count) / (recovery * count)))
    return np.ascontiguousarray(sliding_window_view(from_zero, count)[count - instants].T)


def _power(time: FloatArray, values: FloatArray, frequency: FloatArray, duration: float) -> FloatArray:
    """|sum v e^(-2 pi i f t)|^2 / n of columns (n, m) at every frequency, half spacings from the slowest line on."""
    count = len(values)
    if np.ptp(np.diff(time)) >= 1e-3 * duration / count:
        return uneven_power(time, values, frequency)
    first = DETECTION.oversampling * DETECTION.slowest_line // 2
    power = np.abs(np.fft.rfft(values, DETECTION.oversampling * count, axis=0)) ** 2 / count
    return np.asarray(power[first : first + len(frequency)])


def uneven_power(time: FloatArray, values: FloatArray, frequency: FloatArray) -> FloatArray:
    """|sum v e^(-2 pi i f t)|^2 / n of values (n,) or columns (n, m) at every frequency."""
    power = np.empty((len(frequency), *values.shape[1:]))
    for first in range(0, len(frequency), 256):
        part = slice(first, first + 256)
        power[part] = np.abs(np.exp(-2j * np.pi * np.outer(frequency[part], time)) @ values) ** 2 / len(values)
    return power


def running_median(values: FloatArray, window: int) -> FloatArray:
    """Median over blocks of `window`, interpolated between their centres."""
    pieces = max(len(values) // window, 1)
    width, longer = divmod(len(values), pieces)
    split = longer * (width + 1)  # the first blocks are one longer
    blocks = values[:split].reshape(longer, width + 1), values[split:].reshape(pieces - longer, width)
    ends = np.cumsum([0] + [width + 1] * longer + [width] * (pieces - longer))
    centres = 0.5 * (ends[:-1] + ends[1:] - 1)
    medians = np.concatenate([np.median(block, axis=1) for block in blocks if block.size])
    return np.asarray(np.interp(np.arange(len(values)), centres, medians))
