"""What a record offers to a law and to an effect."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields, replace
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from probation import _core
from probation.effects.backlash import behind, path_since_reversal
from probation.effects.sudden import NEAR, Sudden, sudden_rises
from probation.errors import InputError
from probation.law.companion import RATE_FLOOR
from probation.law.kinematics import haward_thackray_strain
from probation.law.schemes import as_scheme
from probation.records.conversions import volume_strain_from
from probation.records.noise import stress_noise
from probation.records.quantisation import quantisation_step
from probation.settings.effects import EFFECTS
from probation.smoothing.excitation import excitations_of

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.law.schemes import Scheme, SchemeName
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

_MOVING = 10.0 * RATE_FLOOR

TAUT = 1e-3
"""Part of an elongation. What a specimen misses until it first moves is slack if it is more of what was recorded until
then, and if the step after misses less of that.
"""


class Measured(NamedTuple):
    """Where a view comes from.

    Attributes
    ----------
    excitation : Excitation
        What drives the law, at the samples.
    """

    record: Record
    excitation: Excitation


@dataclass(frozen=True, eq=False)
class RecordView:
    """One record as laws and effects see it.

    Between two samples there may be further instants (`stride` of them per sample), so that a scheme's own error is
    small; everything of shape (n,) lives on the instants, what was measured, of shape (n_samples,), on the samples.

    Attributes
    ----------
    time : ndarray, shape (n,) [s]
    true_strain : ndarray, shape (n,) [-]
        As it drives the law: recorded and perhaps smoothed; in a view from `driven`, what an effect made of it.
    recorded_strain : ndarray, shape (n,) [-]
        The same without effects.
    strain_rate : ndarray, shape (n,) [1/s], or None
        None: the scheme's own difference of the strain.
    jumps : tuple of int
        Instants at which the rate is discontinuous.
    direction : ndarray, shape (n - 1,)
        Commanded direction of each step, +1, -1 or 0.
    data : ndarray, shape (n_samples,) [MPa]
        The recorded true stress.
    stride : int
        Instants from sample to sample.
    scheme : Scheme or its name
        Whose difference of the strain is meant.
    temperature : ndarray, shape (n_samples,) [°C], or None
        Declared, if it is one number all along; else measured.
    transverse_strain : ndarray, shape (n_samples,) [-], or None
        Logarithmic, as it was measured.
    index, count : int
        Place among the records of the campaign, in order of test, and how many there are.
    quiet_stress : ndarray, shape (n,) [MPa], or None
        The recorded true stress without its noise, where that is known: see `CampaignModel.quietened`. Effects that
        hand the recorded force back to the strain take it; with a companion relation noise would count as straining.
    specimen_id : str or None
        Records of one specimen share its deviations.
    reference_rate : float
        Rate at which a law without rate dependence and one with it agree [1/s]; one number for all records.
    measured : Measured or None
        None for a test that is only planned.
    reference_temperature : float or None
        Where the law's parameters are meant [°C]: one number for all records, None unless each has its temperature.
    same_data : RecordView or None
        In a view from `driven` or `quietened`, the one that it was made of: what was recorded is the same.
    kinks_held : bool
        Whether `driven` leaves `jumps` as they are: see `with_kinks`.
    """

    id: str
    control: str
    role: str
    time: FloatArray
    true_strain: FloatArray
    recorded_strain: FloatArray
    strain_rate: FloatArray | None
    jumps: tuple[int, ...]
    direction: FloatArray
    data: FloatArray
    stride: int
    scheme: Scheme | SchemeName
    temperature: FloatArray | None
    index: int
    count: int
    reference_rate: float
    quiet_stress: FloatArray | None = None
    specimen_id: str | None = None
    measured: Measured | None = None
    reference_temperature: float | None = None
    same_data: RecordView | None = None
    transverse_strain: FloatArray | None = None
    kinks_held: bool = False

    def __len__(self) -> int:
        return len(self.time)

    @cached_property
    def history(self) -> _core.History:
        """The same as the engine takes it."""
        rate = np.empty(0) if self.strain_rate is None else self.strain_rate
        return _core.History(self.time, self.true_strain, rate, list(self.jumps), self.direction.astype(np.int32))

    @property
    def elapsed(self) -> FloatArray:
        """Time since the start, shape (n,) [s]."""
        return np.asarray(self.time - self.time[0])

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.time[-1] - self.time[0])

    @cached_property
    def signed_rate(self) -> FloatArray:
        """Strain rate, shape (n,) [1/s]; at a jump it is the one before it."""
        if self.strain_rate is not None:
            return self.strain_rate
        begin, end = self.history.rates(_core.Differentiator.three_point)
        return np.append(begin[:1], end)

    @cached_property
    def rate(self) -> FloatArray:
        """Modulus of the strain rate that relaxation times follow, not below the floor; shape (n,) [1/s].

        A rate against the commanded direction is noise and counts as none.
        """
        rate = self.signed_rate.copy()
        step = np.append(self.direction[:1], self.direction)
        rate[step * rate < 0.0] = 0.0
        return np.maximum(np.abs(rate), RATE_FLOOR)

    @cached_property
    def log_rate(self) -> FloatArray:
        """Natural logarithm of the rate over the reference rate, shape (n,) [-]."""
        return np.log(self.rate / self.reference_rate)

    @cached_property
    def largest_strain(self) -> FloatArray:
        """Largest strain so far, not below 0; shape (n,) [-]."""
        return np.maximum.accumulate(np.maximum(self.true_strain, 0.0))

    @cached_property
    def strain_behind_backlash(self) -> FloatArray:
        """The strain behind a backlash of `backlash` of its range, shape (n,): noise does not lengthen its path."""
        return behind(self.true_strain, EFFECTS.backlash * float(np.ptp(self.true_strain)))

    @cached_property
    def path_since_reversal(self) -> FloatArray:
        """Length of the strain's path since it last turned, shape (n,); infinite before it first does.

        A stiff specimen turns within a thousandth of the strain it has come to: what counts is the strain's noise, not
        a part of its range.
        """
        return path_since_reversal(behind(self.true_strain, EFFECTS.return_over_noise * self.strain_noise))

    @cached_property
    def haward_thackray_strain(self) -> FloatArray:
        """e^(2 strain) - e^(-strain), shape (n,) [-]."""
        return haward_thackray_strain(self.true_strain)

    @cached_property
    def first_invariant(self) -> FloatArray:
        """I_1 - 3 of the left Cauchy-Green tensor, isochoric; shape (n,) [-]."""
        return np.expm1(2.0 * self.true_strain) + 2.0 * np.expm1(-self.true_strain)

    @cached_property
    def stretch(self) -> FloatArray:
        """e^recorded strain, shape (n,): true over nominal stress as it was recorded."""
        return np.exp(self.recorded_strain)

    @cached_property
    def sudden_falls(self) -> Sudden:
        """Sudden falls of the force, towards none; their sizes add up to nominal stress, (n,) [MPa]."""
        if self.same_data is not None:
            return self.same_data.sudden_falls
        force = self.data / self.sampled(self.stretch)
        near_jumps = np.zeros(len(force) - 1, dtype=np.bool_)
        for jump in np.searchsorted(self.sampled(self.time), self.time[list(self.jumps)]):
            near_jumps[max(jump - NEAR - 1, 0) : jump + NEAR + 1] = True
        step = max(quantisation_step(force), quantisation_step(self.data))
        falls = sudden_rises(-force if np.sum(force) >= 0.0 else force, step, near_jumps)
        return Sudden(falls.times, np.interp(self.time, self.sampled(self.time), falls.total))

    @cached_property
    def sudden_jumps(self) -> Sudden:
        """Sudden changes of the strain as it drives the law, (n,) [-]; none where they are much of its path.

        Then it is read less often than the force, in coarse steps, or was commanded in steps.
        """
        if self.same_data is not None:
            return self.same_data.sudden_jumps
        strain = self.sampled(self.recorded_strain)
        step = quantisation_step(strain)
        up, down = sudden_rises(strain, step), sudden_rises(-strain, step)
        if up.total[-1] + down.total[-1] > EFFECTS.most_sudden * float(np.sum(np.abs(np.diff(strain)))):
            return Sudden(0, np.zeros(len(self)))
        total = np.interp(self.time, self.sampled(self.time), up.total - down.total)
        return Sudden(up.times + down.times, total)

    @property
    def temperature_is_measured(self) -> bool:
        """Whether there is a column of temperatures that are not all one number."""
        return self.temperature is not None and float(np.ptp(self.temperature)) > 0.0

    @cached_property
    def smooth_temperature(self) -> FloatArray | None:
        """Temperature without the noise of its readings, shape (n_samples,) [°C]: by a penalised spline, if measured.

        A law that it drives would take its noise for warming and cooling.
        """
        if self.same_data is not None:
            return self.same_data.smooth_temperature
        if self.temperature is None or not self.temperature_is_measured:
            return self.temperature
        from probation.smoothing.penalised_spline import smooth_cubic  # noqa: PLC0415 - few need scipy.interpolate

        return smooth_cubic(self.sampled(self.time), self.temperature).true_strain

    @cached_property
    def warmer_than_reference(self) -> FloatArray | None:
        """Temperature above the reference temperature, shape (n,) [°C]; None where either is not known."""
        smooth = self.smooth_temperature
        if smooth is None or self.reference_temperature is None:
            return None
        return np.asarray(np.interp(self.time, self.sampled(self.time), smooth) - self.reference_temperature)

    @cached_property
    def measured_rise(self) -> FloatArray | None:
        """Measured temperature above that of the start, shape (n,) [°C]; None where it was not measured."""
        smooth = self.smooth_temperature
        if smooth is None or not self.temperature_is_measured:
            return None
        return np.asarray(np.interp(self.time, self.sampled(self.time), smooth - smooth[0]))

    @cached_property
    def volume_strain(self) -> FloatArray | None:
        """Logarithm of the volume over the first, shape (n,) [-]; None where no transverse strain was measured.

        Without the noise of the readings, by a penalised spline between jumps of the rate: a transverse strain counts
        twice, and what an extensometer reads to 1e-3 would be 0.1 MPa of noise in a stress of 50 MPa.
        """
        if self.transverse_strain is None:
            return None
        if self.same_data is not None:
            return self.same_data.volume_strain
        measured = volume_strain_from(self.sampled(self.recorded_strain), self.transverse_strain)
        return self._between_jumps(measured)

    @cached_property
    def nominal_data(self) -> FloatArray:
        """Recorded force over the initial section, quiet if that is known, else linear between samples; (n,) [MPa]."""
        if self.quiet_stress is not None:
            return self.quiet_stress / self.stretch
        samples = self.data / self.sampled(self.stretch)
        return samples if self.stride == 1 else np.interp(self.time, self.sampled(self.time), samples)

    @cached_property
    def smooth_nominal_data(self) -> FloatArray:
        """Recorded force over the initial section by a penalised spline between jumps of the rate, (n,) [MPa].

        No law enters it, unlike `nominal_data`, except where a prediction is what was recorded. Kinks that are no jump
        of the rate are rounded.
        """
        if self.same_data is not None:
            return self.same_data.smooth_nominal_data
        if self.quiet_stress is not None:
            return self.nominal_data
        return self._between_jumps(self.data / self.sampled(self.stretch))

    def _between_jumps(self, samples: FloatArray) -> FloatArray:
        """By a penalised spline between jumps of the rate, from (n_samples,) to (n,)."""
        from probation.smoothing.penalised_spline import smooth_cubic  # noqa: PLC0415 - few need scipy.interpolate
        from probation.smoothing.segmented import smooth_segments  # noqa: PLC0415

        time = self.sampled(self.time)
        jumps = [jump // self.stride for jump in self.jumps]
        smooth = smooth_segments(smooth_cubic, time, samples, jumps, noise=0.0).true_strain
        return smooth if self.stride == 1 else np.interp(self.time, time, smooth)

    @property
    def smooth_true_data(self) -> FloatArray:
        """The recorded true stress that goes with `smooth_nominal_data`, (n,) [MPa]."""
        return self.smooth_nominal_data * self.stretch

    def sampled(self, values: FloatArray) -> FloatArray:
        """Values at the samples, of values at the instants."""
        return values[:: self.stride]

    @property
    def record(self) -> Record:
        """The record that this is a view of."""
        assert self.measured is not None, "a planned test has no record"
        return self.measured.record

    @property
    def excitation(self) -> Excitation:
        """What drives the law along the record, at the samples."""
        assert self.measured is not None, "a planned test has no excitation"
        return self.measured.excitation

    @property
    def strain_noise(self) -> float:
        """Standard deviation of the recorded strain's noise [-]; 0 of a planned test, whose strain is known."""
        return 0.0 if self.measured is None else self.excitation.strain_noise

    @property
    def stress_noise(self) -> float:
        """Standard deviation of the record's stress noise [MPa]: as stated, else as it scatters."""
        return stress_noise(self.record)

    def with_substeps(self, substeps: int) -> RecordView:
        """The same with so many instants from sample to sample."""
        return self._solved_on(self.excitation, substeps)

    def with_scheme(self, scheme: Scheme | SchemeName) -> RecordView:
        """The same solved by another scheme, on the same instants."""
        return replace(self, scheme=scheme)

    def smoothed_as(self, excitation: Excitation) -> RecordView:
        """The same record, its strain smoothed otherwise."""
        return self._solved_on(excitation, self.stride)

    def _solved_on(self, excitation: Excitation, substeps: int) -> RecordView:
        fine = excitation.refined(substeps)
        return replace(
            self,
            time=fine.time,
            true_strain=fine.true_strain,
            recorded_strain=fine.true_strain,
            strain_rate=fine.strain_rate,
            jumps=fine.jumps,
            direction=fine.direction,
            stride=substeps,
            quiet_stress=None,
            same_data=None,
            measured=Measured(self.record, excitation),
        )

    def with_data(self, data: FloatArray) -> RecordView:
        """The same test with other stresses recorded, shape (n_samples,) [MPa]: a bootstrap's."""
        if data.shape != self.sampled(self.time).shape:
            raise InputError(f"{self.id}: found data of shape {data.shape}, expected {self.sampled(self.time).shape}")
        return replace(self, data=data, quiet_stress=None, same_data=None)

    def as_predicted(self, stress: FloatArray) -> RecordView:
        """The same test with a prediction recorded, true stress, shape (n,) [MPa], without noise.

        So has a planned test: a machine's compliance acts on the force that there is.
        """
        return replace(self, data=self.sampled(stress), quiet_stress=stress, same_data=None)

    def quietened(self, stress: FloatArray) -> RecordView:
        """The same record, effects that hand its force back to the strain taking this true stress, shape (n,) [MPa]."""
        return self._with(quiet_stress=stress, same_data=self.same_data or self)

    def with_kinks(self, jumps: tuple[int, ...]) -> RecordView:
        """The same record, whatever drives the law having these jumps of the rate and no further kink.

        A kink that passes a sample would make the stress jump, and what is sought in small steps stumbles over that.
        """
        return self._with(jumps=jumps, kinks_held=True, same_data=self.same_data or self)

    def driven(self, true_strain: FloatArray) -> RecordView:
        """The same record with another strain driving the law; given rates follow by the scheme's difference.

        Where slack ends, the specimen's strain has a kink within a step: its rate jumps at either end.
        """
        rate, jumps = self.strain_rate, self.jumps
        if not self.kinks_held and (kink := self._taut_from(true_strain)):
            jumps = tuple(sorted({*jumps, kink - 1, kink}))
        if rate is not None:
            backward = as_scheme(self.scheme).name == "be2"
            how = _core.Differentiator.backward if backward else _core.Differentiator.three_point
            moved = _core.History(self.time, true_strain - self.true_strain, np.empty(0), list(jumps))
            begin, end = moved.rates(how)
            rate = rate + np.append(begin[:1], end)
        return self._with(true_strain=true_strain, strain_rate=rate, jumps=jumps, same_data=self.same_data or self)

    def _taut_from(self, true_strain: FloatArray) -> int:
        """The first instant with another strain than the first, if less was seen until then, and no less after it."""
        first = int(np.argmax(true_strain > true_strain[0]))
        if first == 0 or first + 1 >= len(true_strain):
            return 0
        recorded, seen = self.true_strain, true_strain
        moved, after = (math.expm1(recorded[at] - recorded[0]) for at in (first, first + 1))
        missed = moved - math.expm1(seen[first] - seen[0])
        further = after - math.expm1(seen[first + 1] - seen[0]) - missed
        return first if missed > TAUT * moved and abs(further) < TAUT * missed else 0

    def _with(self, **changed: object) -> RecordView:
        """The same with other values. `replace` takes some ten times as long; a search makes 40 000 views."""
        known, other = self.__dict__, object.__new__(RecordView)
        other.__dict__.update({name: known[name] for name in _FIELDS} | changed)
        return other


_FIELDS = tuple(each.name for each in fields(RecordView))


def largest_strain_of(views: Sequence[RecordView]) -> float:
    """Largest true strain of all records [-], not below 0."""
    return max(float(np.max(view.largest_strain)) for view in views)


def view_of(
    record: Record,
    excitation: Excitation,
    *,
    index: int = 0,
    count: int = 1,
    reference_rate: float | None = None,
    reference_temperature: float | None = None,
    scheme: Scheme | SchemeName = "be2",
    substeps: int = 1,
) -> RecordView:
    """The view of one record.

    Parameters
    ----------
    excitation : Excitation
        From `probation.excite`, at the samples.
    index, count, reference_temperature, scheme
        As in `RecordView`.
    reference_rate : float, optional
        As in `RecordView`; the record's own by default.
    substeps : int
        Instants from sample to sample.
    """
    fine = excitation.refined(substeps)
    return RecordView(
        id=record.id,
        control=record.control,
        role=record.role,
        time=fine.time,
        true_strain=fine.true_strain,
        recorded_strain=fine.true_strain,
        strain_rate=fine.strain_rate,
        jumps=fine.jumps,
        direction=fine.direction,
        data=record.true_stress,
        stride=substeps,
        scheme=scheme,
        temperature=record.temperature,
        transverse_strain=record.transverse_strain,
        index=index,
        count=count,
        reference_rate=reference_rate_of([excitation]) if reference_rate is None else reference_rate,
        reference_temperature=reference_temperature,
        specimen_id=record.specimen_id,
        measured=Measured(record, excitation),
    )


def views_of(
    campaign: Campaign,
    *,
    excitations: Mapping[str, Excitation] | None = None,
    scheme: Scheme | SchemeName = "be2",
    substeps: int = 1,
) -> tuple[RecordView, ...]:
    """Views of all records of a campaign, held-out ones too, in its order.

    Parameters
    ----------
    excitations : dict of str to Excitation, optional
        By record id; made by `excitations_of` if left out.
    scheme, substeps
        As in `view_of`.
    """
    known = excitations or excitations_of(campaign.records)
    reference = reference_rate_of([known[record.id] for record in campaign.identify])
    temperature = reference_temperature_of(campaign.records)
    count = len(campaign.records)
    return tuple(
        view_of(
            record,
            known[record.id],
            index=index,
            count=count,
            reference_rate=reference,
            reference_temperature=temperature,
            scheme=scheme,
            substeps=substeps,
        )
        for index, record in enumerate(campaign.records)
    )


def reference_rate_of(excitations: Sequence[Excitation]) -> float:
    """Geometric mean of the records' median rates while moving, to one digit [1/s]; 1e-3 if none moves."""
    if not excitations:
        raise InputError("found no records, expected at least one")
    medians = []
    for excitation in excitations:
        rate = np.abs(excitation.rate)
        if np.any(rate > _MOVING):
            medians.append(np.median(np.log(rate[rate > _MOVING])))
    return float(f"{np.exp(np.mean(medians)):.0e}") if medians else 1e-3


def reference_temperature_of(records: Sequence[Record]) -> float | None:
    """Mean of the temperatures at which the records start, to a degree [°C]; None unless each has its temperature."""
    starts = [float(record.temperature[0]) for record in records if record.temperature is not None]
    return float(round(np.mean(starts))) if starts and len(starts) == len(records) else None
