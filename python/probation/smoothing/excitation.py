"""What drives the law along one record: strain, rate, jumps, and how they were had."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation._arrays import FloatArray, one_of
from probation._short_repr import ShortRepr
from probation.errors import InputError
from probation.law.history import StrainHistory
from probation.law.refinement import fine_time, refine
from probation.records.noise import noise_level
from probation.results.data import CURVE, LEFT_OUT, WithCurves
from probation.settings.smoothing import SMOOTHING
from probation.smoothing.averaging import Averaging, segments_of
from probation.smoothing.differences import differences, differences_error
from probation.smoothing.methods import DEFAULT, METHODS, SMOOTHERS, Method
from probation.smoothing.operators import Operators
from probation.smoothing.segmented import smooth_segments
from probation.smoothing.segments import find_jumps

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator, Sequence

    from probation.records.record import Record


@dataclass(frozen=True, eq=False)
class Excitation(ShortRepr, WithCurves):
    """Strain and rate as the law sees them.

    Attributes
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
    strain_rate : ndarray, shape (n_times,) [1/s], or None
        None: the scheme's own difference of the strain.
    jumps : tuple of int
        Indices at which the rate is discontinuous.
    direction : ndarray, shape (n_times - 1,)
        Commanded direction of each step, +1, -1 or 0.
    differentiator : str
        How the rate was had, in words.
    strain_noise : float
        Standard deviation of the measured strain's noise [-].
    method : str
        One of `METHODS`, never "auto".
    strain_se : ndarray, shape (n_times,) [-]
        Standard error of `true_strain`. Of a spline it covers its bias, too, on average along the curve (Nychka 1988).
    rate_se : ndarray, shape (n_times,) [1/s]
        ... and of `rate`; for a rate given with the record, its own scatter from sample to sample.
    freedom : float
        Degrees of freedom that the samples were described with.
    noise_inflation : float
        Variance of slow averages of the strain's noise over what white noise would have: 1 where it is white. Within
        the standard errors already.
    operators : callable, or None
        Makes what the measured samples do to strain and rate; None where the strain is as measured.
    errors : callable, or None
        Makes strain and rate by independent errors, for strain noise of standard deviation 1 and the inflation; None
        where the strain is as measured.
    """

    time: FloatArray = field(metadata=CURVE)
    true_strain: FloatArray = field(metadata=CURVE)
    strain_rate: FloatArray | None = field(metadata=CURVE)
    jumps: tuple[int, ...]
    direction: FloatArray = field(metadata=CURVE)
    differentiator: str
    strain_noise: float
    method: Method
    strain_se: FloatArray = field(metadata=CURVE)
    rate_se: FloatArray = field(metadata=CURVE)
    freedom: float
    noise_inflation: float = 1.0
    operators: Callable[[], Operators] | None = field(default=None, metadata=LEFT_OUT)
    errors: Callable[[], Operators] | None = field(default=None, metadata=LEFT_OUT)

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

    def rate_covariance(self) -> FloatArray | None:
        """Covariance of `strain_rate` from white noise of `strain_noise`, shape (n_times, n_times) [1/s^2].

        None where `rate_operator` is None.
        """
        operator = self.rate_operator()
        return None if operator is None else self.strain_noise**2 * operator @ operator.T

    def strain_history(self) -> StrainHistory:
        """The same as a law takes it."""
        return StrainHistory(
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
            begin, end = self.strain_history().engine.rates(_core.Differentiator.backward)
        strain, rate = refine(self.time, substeps, self.true_strain, self.strain_rate, begin, end)
        time = fine_time(self.time, substeps)
        return replace(
            self,
            time=time,
            true_strain=strain,
            strain_rate=rate,
            jumps=tuple(substeps * jump for jump in self.jumps),
            direction=np.repeat(self.direction, substeps),
            strain_se=np.interp(time, self.time, self.strain_se),
            rate_se=np.interp(time, self.time, self.rate_se),
            operators=partial(self._refined_operators, substeps),
            errors=None if self.errors is None else partial(self._refined_errors, self.errors, substeps),
        )

    def _refined_operators(self, substeps: int) -> Operators:
        strain = self.strain_operator()
        return self._refined(np.eye(len(self.time)) if strain is None else strain, self.rate_operator(), substeps)

    def _refined_errors(self, errors: Callable[[], Operators], substeps: int) -> Operators:
        made = errors()
        return self._refined(made.strain, made.rate, substeps)

    def _refined(self, strain: FloatArray, rate: FloatArray | None, substeps: int) -> Operators:
        """The map to the strain and rate of `refined`, which is linear in those of the samples."""
        begin = end = None
        if rate is not None and self.strain_rate is not None:
            # At a jump the engine takes the secant on one side: the same side here.
            secant = np.diff(strain, axis=0) / np.diff(self.time)[:, None]
            used = self.strain_history().engine.rates(_core.Differentiator.backward)
            own = [
                side == given for side, given in zip(used, (self.strain_rate[:-1], self.strain_rate[1:]), strict=True)
            ]
            begin = np.where(own[0][:, None], rate[:-1], secant)
            end = np.where(own[1][:, None], rate[1:], secant)
        fine, fine_rate = refine(self.time, substeps, strain, rate, begin, end)
        return Operators(fine, np.zeros_like(fine) if fine_rate is None else fine_rate)

    @property
    def rate(self) -> FloatArray:
        """The strain rate that was given or smoothed, else three-point differences; shape (n_times,) [1/s]."""
        if self.strain_rate is not None:
            return self.strain_rate
        return differences(self.time, self.true_strain)


def excite(record: Record, method: Method = "auto") -> Excitation:
    """Strain and rate of one record, fit for driving the law.

    Parameters
    ----------
    record : Record
    method : str
        One of `METHODS`. "raw" takes the strain as it is (and the rate if the record has one), the others smooth it,
        segment by segment; "auto" does so by `DEFAULT` where the strain is noisy, the record has no rate of its own,
        and the smoother follows the record.

    Raises
    ------
    InputError
        For an unknown method, or one that does not describe the record.
    """
    return next(excite_each([record], method))


def excite_each(
    records: Sequence[Record], method: Method = "auto", *, further: Sequence[Record] = ()
) -> Iterator[Excitation]:
    """Those of the records of one campaign, in their order.

    Their strains have the same extensometer. All of them together show how far it averages its noise: a segment in
    which the curve hides an average would be followed too closely.

    Parameters
    ----------
    records : sequence of Record
    method : str
        As in `excite`.
    further : sequence of Record
        Other records of the campaign, which only show how the extensometer averages.

    Raises
    ------
    InputError
        As in `excite`.
    """
    one_of(method, "excitation", METHODS)
    measured = [_Measured.of(record, method) for record in (*records, *further)]
    smoothed = [measurement for measurement in measured if measurement.method != "raw"]
    averaging = Averaging.pooled(
        segment
        for measurement in smoothed
        for segment in segments_of(measurement.record.true_strain, measurement.jumps)
    )
    for wanted in measured[: len(records)]:
        yield wanted.known(averaging).excitation(averaging.inflation, automatic=method == "auto")


def excitations_of(
    records: Sequence[Record], method: Method = "auto", *, further: Sequence[Record] = ()
) -> dict[str, Excitation]:
    """The same by record id."""
    driven = excite_each(records, method, further=further)
    return {record.id: drive for record, drive in zip(records, driven, strict=True)}


@dataclass(frozen=True, eq=False)
class _Measured:
    """The strain of a record before it is smoothed: its noise, its jumps, and the method, never "auto"."""

    record: Record
    noise: float
    jumps: list[int]
    method: Method

    @classmethod
    def of(cls, record: Record, method: Method) -> _Measured:
        given = record.noise.strain
        noise = given if given is not None else noise_level(record.time, record.true_strain)
        jumps = find_jumps(record.time, record.true_strain, noise, record.true_stress)
        if method == "auto":
            method = DEFAULT if record.strain_rate is None and _rate_is_noisy(record, noise) else "raw"
        return cls(record, noise, jumps, method)

    def known(self, averaging: Averaging) -> _Measured:
        """The same where its noise is averaged: neighbours tell less of it, and see jumps where none are."""
        if self.method == "raw" or averaging.inflation <= SMOOTHING.correlated:
            return self
        record, noise = self.record, self.noise
        if record.noise.strain is None:
            noise *= float(np.sqrt(averaging.hidden))
        jumps = find_jumps(
            record.time, record.true_strain, noise * float(np.sqrt(averaging.inflation)), record.true_stress
        )
        return replace(self, noise=noise, jumps=jumps)

    def excitation(self, averaged: float, *, automatic: bool) -> Excitation:
        """Smoothed where that is the method; `averaged` as in `smooth_segments`."""
        record, noise, jumps, method = self.record, self.noise, self.jumps, self.method
        if method == "raw":
            return _as_measured(record, jumps, noise)
        way = SMOOTHERS[method]
        if jumps and not way.segmented:
            raise InputError(
                f"record {record.id!r}, excitation {method!r}: found a rate that jumps at "
                f"{', '.join(f'{record.time[jump]:.4g}' for jump in jumps)} s, expected a smooth history; use "
                f"{DEFAULT!r}"
            )
        try:
            smoothed = smooth_segments(
                way.smooth,
                record.time,
                record.true_strain,
                jumps,
                noise,
                lagging=way.smooth_lagging,
                averaged=averaged,
            )
        except InputError as error:
            raise InputError(f"record {record.id!r}, excitation {method!r}: {error}") from None
        if automatic and smoothed.noise > SMOOTHING.misses * max(noise, SMOOTHING.clean):
            return _as_measured(record, jumps, noise)
        # What the smoother leaves says more of the noise than neighbouring samples do: slow noise shows in it, too.
        noise = smoothed.noise if record.noise.strain is None else noise
        return Excitation(
            time=record.time,
            true_strain=smoothed.true_strain,
            strain_rate=smoothed.strain_rate,
            jumps=tuple(jumps),
            direction=_direction(record, smoothed.true_strain, jumps, noise),
            differentiator=way.title + (f", {len(jumps) + 1} segments between jumps" if jumps else ""),
            strain_noise=float(noise),
            method=method,
            strain_se=noise * smoothed.strain_error,
            rate_se=noise * smoothed.rate_error,
            freedom=smoothed.freedom,
            noise_inflation=smoothed.inflation,
            operators=smoothed.operators,
            errors=smoothed.errors,
        )


def _as_measured(record: Record, jumps: list[int], noise: float) -> Excitation:
    """The samples themselves, and the rate if the record has one."""
    strain, rate = record.true_strain, record.strain_rate
    if rate is None:
        name = "three-point backward difference (bE2), parabola through three samples (SA2, SA3)"
        rate_se = noise * differences_error(record.time)
    else:
        name = "rate given with the record"
        rate_se = np.full(len(rate), noise_level(record.time, rate))
    return Excitation(
        time=record.time,
        true_strain=strain,
        strain_rate=rate,
        jumps=tuple(jumps),
        direction=_direction(record, strain, jumps, noise),
        differentiator=name,
        strain_noise=float(noise),
        method="raw",
        strain_se=np.full(len(strain), float(noise)),
        rate_se=rate_se,
        freedom=float(len(strain)),
    )


def _rate_is_noisy(record: Record, noise: float) -> bool:
    """Whether three-point differences of the strain scatter by more than `rate_noise` of the typical rate."""
    if noise < SMOOTHING.clean:
        return False
    step = np.diff(record.time)
    typical = np.median(np.abs(np.diff(record.true_strain) / step))
    # (3 e+ - 4 e + e-) / 2 h has sqrt(26) / 2 times the noise over h.
    return bool(np.sqrt(26.0) / 2.0 * noise / np.median(step) > SMOOTHING.rate_noise * typical)


def _direction(record: Record, true_strain: FloatArray, jumps: list[int], noise: float) -> FloatArray:
    """Sign of each segment's net strain; 0 where the strain comes back beyond its noise, or nothing was commanded."""
    direction = np.zeros(len(true_strain) - 1)
    if record.control in ("cyclic", "other"):
        return direction
    turn = max(SMOOTHING.turn * float(np.ptp(true_strain)), SMOOTHING.beyond_noise * noise)
    borders = [0, *jumps, len(true_strain) - 1]
    for first, last in pairwise(borders):
        sign = 1.0 if true_strain[last] >= true_strain[first] else -1.0
        along = sign * true_strain[first : last + 1]
        back = np.maximum.accumulate(along) - along
        if np.max(back) <= turn:
            direction[first:last] = sign
            for fall in _falls(along, SMOOTHING.beyond_noise * noise):
                direction[first + fall.start : first + fall.stop] = 0.0
    return direction


def _falls(values: FloatArray, least: float) -> list[slice]:
    """Steps from a largest value so far down to the lowest one after it, where that is further down than `least`."""
    highest = np.maximum.accumulate(values)
    peaks = np.flatnonzero(values == highest)
    falls = []
    for start, stop in pairwise([*peaks.tolist(), len(values)]):
        lowest = start + int(np.argmin(values[start:stop]))
        if values[start] - values[lowest] > least:
            falls.append(slice(start, lowest))
    return falls
