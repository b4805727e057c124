"""What drives the law along one record: strain, rate, jumps, and how they were had."""

from __future__ import annotations

from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation import _core
from probation._arrays import FloatArray, one_of
from probation.excitation.segments import CLEAN, find_jumps
from probation.excitation.smoothing import smooth_segments
from probation.history import make_history
from probation.records.noise import scatter

if TYPE_CHECKING:
    from probation.records import Record

Method = Literal["auto", "raw", "spline"]
METHODS: tuple[Method, ...] = ("auto", "raw", "spline")

RATE_NOISE = 2e-3
"""Smooth where the differenced strain's noise exceeds this fraction of the typical rate."""

TURN = 0.02
"""A segment that comes back by more than this fraction of the record's strain range has no single direction."""


@dataclass(frozen=True, eq=False)
class Excitation:
    """Strain and rate as the law sees them.

    Attributes
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    strain_rate : ndarray, shape (n_times,) [1/s], or None
        None: the scheme's own difference of the strain.
    jumps : tuple of int
        Indices at which the rate jumps.
    direction : ndarray, shape (n_times - 1,)
        Commanded direction of each step, +1, -1 or 0.
    differentiator : str
        How the rate was had, in words.
    strain_noise : float
        Standard deviation of the measured strain's noise [-].
    """

    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray | None
    jumps: tuple[int, ...]
    direction: FloatArray
    differentiator: str
    strain_noise: float

    def history(self) -> _core.History:
        """The same as the engine takes it."""
        return make_history(
            self.time,
            self.true_strain,
            strain_rate=self.strain_rate,
            jumps=self.time[list(self.jumps)] if self.jumps else None,
            direction=self.direction,
        )

    def refined(self, substeps: int) -> Excitation:
        """The same history at `substeps` times as many instants; every `substeps`-th is one of the samples.

        Between samples it is what the samples stand for: a straight line, or, with rates, the cubic through both.
        """
        if substeps == 1:
            return self
        part = np.arange(substeps) / substeps
        step, rise = np.diff(self.time)[:, None], np.diff(self.true_strain)[:, None]
        time = _spread(self.time[:-1, None] + step * part, self.time[-1])
        strain = self.true_strain[:-1, None] + rise * part
        rate = None
        if self.strain_rate is not None:
            begin, end = (side[:, None] for side in self.history().rates(_core.Differentiator.backward))
            bend = (1.0 - part) * (step * begin - rise) + part * (rise - step * end)
            strain = strain + part * (1.0 - part) * bend
            slope = (
                rise + (1.0 - 2.0 * part) * bend + part * (1.0 - part) * (2.0 * rise - step * (begin + end))
            ) / step
            slope[:, 0] = self.strain_rate[:-1]
            rate = _spread(slope, self.strain_rate[-1])
        return replace(
            self,
            time=time,
            true_strain=_spread(strain, self.true_strain[-1]),
            strain_rate=rate,
            jumps=tuple(substeps * jump for jump in self.jumps),
            direction=np.repeat(self.direction, substeps),
        )

    @property
    def rate(self) -> FloatArray:
        """The strain rate that was given or smoothed, else three-point differences; shape (n_times,) [1/s]."""
        if self.strain_rate is not None:
            return self.strain_rate
        return np.gradient(self.true_strain, self.time)


def excite(record: Record, method: Method = "auto") -> Excitation:
    """Strain and rate of one record, fit for driving the law.

    Parameters
    ----------
    record : Record
    method : {"auto", "raw", "spline"}
        "raw" takes the strain as it is (and the rate if the record has one); "spline" smooths it, segment by segment;
        "auto" does so where the strain is noisy and the record has no rate of its own.

    Raises
    ------
    InputError
        For an unknown method.
    """
    one_of(method, "excitation", METHODS)
    noise = record.noise.strain if record.noise.strain is not None else scatter(record.time, record.true_strain)
    jumps = find_jumps(record.time, record.true_strain, noise)
    strain, rate = record.true_strain, record.strain_rate
    name = "three-point backward difference (bE2), parabola through three samples (SA2, SA3)"
    if rate is not None and method != "spline":
        name = "rate given with the record"
    elif method == "spline" or (method == "auto" and _rate_is_noisy(record, noise)):
        strain, rate = smooth_segments(record.time, record.true_strain, jumps)
        name = "cubic smoothing spline (generalised cross-validation)"
        name += f", {len(jumps) + 1} segments between jumps" if jumps else ""
    return Excitation(
        record.time, strain, rate, tuple(jumps), _direction(record, strain, jumps, noise), name, float(noise)
    )


def _spread(rows: FloatArray, last: float) -> FloatArray:
    """Rows of instants within steps as one array, with the last instant of all."""
    return np.append(rows.ravel(), last)


def _rate_is_noisy(record: Record, noise: float) -> bool:
    """Whether three-point differences of the strain scatter by more than `RATE_NOISE` of the typical rate."""
    if noise < CLEAN:
        return False
    step = np.diff(record.time)
    typical = np.median(np.abs(np.diff(record.true_strain) / step))
    # (3 e+ - 4 e + e-) / 2 h has sqrt(26) / 2 times the noise over h.
    return bool(np.sqrt(26.0) / 2.0 * noise / np.median(step) > RATE_NOISE * typical)


def _direction(record: Record, true_strain: FloatArray, jumps: list[int], noise: float) -> FloatArray:
    """Sign of each segment's net strain; 0 where the strain turns inside one, or where nothing was commanded."""
    direction = np.zeros(len(true_strain) - 1)
    if record.control in ("cyclic", "other"):
        return direction
    allowed = max(TURN * float(np.ptp(true_strain)), 10.0 * noise)
    borders = [0, *jumps, len(true_strain) - 1]
    for first, last in pairwise(borders):
        part = true_strain[first : last + 1]
        sign = 1.0 if part[-1] >= part[0] else -1.0
        back = np.max(np.maximum.accumulate(sign * part) - sign * part)
        if back <= allowed:
            direction[first:last] = sign
    return direction
