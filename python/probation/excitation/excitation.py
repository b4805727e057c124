"""What drives the law along one record: strain, rate, jumps, and how they were had."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation import _core
from probation._arrays import FloatArray, one_of
from probation.excitation.operators import Operators
from probation.excitation.segments import CLEAN, find_jumps
from probation.excitation.smoothing import smooth_segments
from probation.history import make_history
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Callable

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
    operators : callable, or None
        Makes what the measured samples do to strain and rate; None where the strain is as measured.
    """

    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray | None
    jumps: tuple[int, ...]
    direction: FloatArray
    differentiator: str
    strain_noise: float
    operators: Callable[[], Operators] | None = None

    def strain_operator(self) -> FloatArray | None:
        """Derivative of `true_strain` by the measured strain at fixed smoothness, shape (n_times, n_measured) [-].

        Dense; None is the identity. Made at the first call and kept. Of a refined history too, where n_times is larger.
        """
        return None if self._made is None else self._made.strain

    def rate_operator(self) -> FloatArray | None:
        """Derivative of `strain_rate` by the measured strain at fixed smoothness, shape (n_times, n_measured) [1/s].

        Dense; None where `strain_rate` is None: the scheme's own difference. A rate given with the record does not
        depend on the strain: zeros.
        """
        if self._made is None:
            return None if self.strain_rate is None else np.zeros((len(self.time), len(self.time)))
        return None if self.strain_rate is None else self._made.rate

    @cached_property
    def _made(self) -> Operators | None:
        return None if self.operators is None else self.operators()

    @cached_property
    def strain_se(self) -> FloatArray:
        """Standard error of `true_strain` from the strain's noise, shape (n_times,) [-]."""
        operator = self.strain_operator()
        if operator is None:
            return np.full(len(self.time), self.strain_noise)
        return self.strain_noise * _row_norms(operator)

    @cached_property
    def rate_se(self) -> FloatArray:
        """Standard error of `rate` from the strain's noise, shape (n_times,) [1/s].

        That of a rate given with the record is its own scatter from sample to sample.
        """
        if self.operators is None and self.strain_rate is not None:
            return np.full(len(self.time), scatter(self.time, self.strain_rate))
        operator = self.rate_operator()
        if operator is None:
            operator = np.asarray(np.gradient(np.eye(len(self.time)), self.time, axis=0))
        return self.strain_noise * _row_norms(operator)

    def strain_covariance(self) -> FloatArray:
        """Covariance of `true_strain` from the strain's noise, shape (n_times, n_times) [-]."""
        operator = self.strain_operator()
        if operator is None:
            return self.strain_noise**2 * np.eye(len(self.time))
        covariance: FloatArray = self.strain_noise**2 * operator @ operator.T
        return covariance

    def rate_covariance(self) -> FloatArray | None:
        """Covariance of `strain_rate` from the strain's noise, shape (n_times, n_times) [1/s^2]; None without one."""
        operator = self.rate_operator()
        return None if operator is None else self.strain_noise**2 * operator @ operator.T

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
        begin = end = None
        if self.strain_rate is not None:
            begin, end = self.history().rates(_core.Differentiator.backward)
        strain, rate = _refine(self.time, substeps, self.true_strain, self.strain_rate, begin, end)
        return replace(
            self,
            time=_spread(
                self.time[:-1, None] + np.diff(self.time)[:, None] * (np.arange(substeps) / substeps), self.time[-1:]
            ),
            true_strain=strain,
            strain_rate=rate,
            jumps=tuple(substeps * jump for jump in self.jumps),
            direction=np.repeat(self.direction, substeps),
            operators=partial(self._refined_operators, substeps),
        )

    def _refined_operators(self, substeps: int) -> Operators:
        """The operators of `refined`, which is linear in strain and rate."""
        strain = self.strain_operator()
        strain = np.eye(len(self.time)) if strain is None else strain
        rate = self.rate_operator()
        begin = end = None
        if rate is not None and self.strain_rate is not None:
            # At a jump the engine takes the secant on one side: the same side here.
            secant = np.diff(strain, axis=0) / np.diff(self.time)[:, None]
            used = self.history().rates(_core.Differentiator.backward)
            own = [
                side == given for side, given in zip(used, (self.strain_rate[:-1], self.strain_rate[1:]), strict=True)
            ]
            begin = np.where(own[0][:, None], rate[:-1], secant)
            end = np.where(own[1][:, None], rate[1:], secant)
        fine, fine_rate = _refine(self.time, substeps, strain, rate, begin, end)
        return Operators(fine, np.zeros_like(fine) if fine_rate is None else fine_rate)

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
    strain, rate, operators = record.true_strain, record.strain_rate, None
    name = "three-point backward difference (bE2), parabola through three samples (SA2, SA3)"
    if rate is not None and method != "spline":
        name = "rate given with the record"
    elif method == "spline" or (method == "auto" and _rate_is_noisy(record, noise)):
        strain, rate, operators = smooth_segments(record.time, record.true_strain, jumps)
        name = "cubic smoothing spline (generalised cross-validation)"
        name += f", {len(jumps) + 1} segments between jumps" if jumps else ""
    return Excitation(
        record.time,
        strain,
        rate,
        tuple(jumps),
        _direction(record, strain, jumps, noise),
        name,
        float(noise),
        operators,
    )


def _row_norms(operator: FloatArray) -> FloatArray:
    norms: FloatArray = np.sqrt(np.einsum("ij,ij->i", operator, operator))
    return norms


def _refine(
    time: FloatArray,
    substeps: int,
    strain: FloatArray,
    rate: FloatArray | None,
    begin: FloatArray | None,
    end: FloatArray | None,
) -> tuple[FloatArray, FloatArray | None]:
    """Strain and rate at `substeps` times as many instants: a straight line, or the cubic through strain and rate.

    Linear in strain, rate and the rates at which each step begins and ends, all with the instants or steps as their
    first axis.
    """
    more = (None,) * (strain.ndim - 1)
    part = (np.arange(substeps) / substeps)[(None, slice(None), *more)]
    step = np.diff(time)[(slice(None), None, *more)]
    rise = np.diff(strain, axis=0)[:, None]
    fine = strain[:-1, None] + rise * part
    if rate is None or begin is None or end is None:
        return _spread(fine, strain[-1:]), None
    begin, end = begin[:, None], end[:, None]
    bend = (1.0 - part) * (step * begin - rise) + part * (rise - step * end)
    fine = fine + part * (1.0 - part) * bend
    slope = (rise + (1.0 - 2.0 * part) * bend + part * (1.0 - part) * (2.0 * rise - step * (begin + end))) / step
    slope[:, 0] = rate[:-1]
    return _spread(fine, strain[-1:]), _spread(slope, rate[-1:])


def _spread(rows: FloatArray, last: FloatArray) -> FloatArray:
    """Instants within steps, (n_steps, substeps, ...), as one axis, with the last instant of all."""
    return np.concatenate([rows.reshape(-1, *rows.shape[2:]), last])


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
