"""Something shakes at one frequency, or once a turn of a screw."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.strain_periodic import likely_periods
from probation.effects.catalogue.strain_offset import true_strain_of
from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_CYCLES = (3.0, 6.0, 12.0, 25.0, 50.0)
"""Frequencies [cycles in the longest record] from which searches begin without residuals, by twos."""
_PEAKS = 3
"""Peaks of a residual's periodogram from which searches begin."""
_FREQUENCY = EffectParameter(
    name="frequency_Hz",
    unit="Hz",
    lower=1e-5,
    upper=100.0,
    centre=0.1,
    scale=float("inf"),
    log=True,
    reason="screws, hydraulics, mains: any",
)
_PHASE = EffectParameter(
    name="phase_rad",
    unit="rad",
    lower=-2.0 * np.pi,
    upper=2.0 * np.pi,
    scale=float("inf"),
    period=np.pi,
    reason="any; with a signed amplitude it repeats itself after half a turn",
)
_PERIODS = EffectParameter(
    name="periods_in_record",
    unit="",
    lower=5.0,
    upper=1e5,
    centre=20.0,
    scale=float("inf"),
    log=True,
    reason="some in the record at least: what has fewer is no wave, but a course that any slow effect may take",
)
_SECOND = 0.1
"""Second harmonic of a screw's wave, over the first, from which searches begin."""
_SCREW = (
    EffectParameter(
        name="period_elongation",
        unit="",
        lower=1e-4,
        upper=2.0,
        centre=0.05,
        scale=float("inf"),
        log=True,
        reason="a screw turns once in 2 to 20 mm, a gauge length is 10 to 100 mm; gears and belts turn faster: any",
    ),
    replace(_PHASE, reason="any; with a signed amplitude it repeats itself after half a turn, the second one with it"),
    EffectParameter(
        name="second_of_wave",
        unit="",
        lower=0.0,
        upper=1.0,
        centre=_SECOND,
        scale=0.3,
        reason="a screw's wave is no sine, and a joint out of line errs twice a turn",
    ),
    EffectParameter(
        name="second_phase_rad",
        unit="rad",
        lower=-2.0 * np.pi,
        upper=2.0 * np.pi,
        scale=float("inf"),
        period=2.0 * np.pi,
        reason="any",
    ),
)
_LASTING = EffectParameter(
    name="lasting_periods",
    unit="",
    lower=1.0,
    upper=30.0,
    centre=3.0,
    scale=1.0,
    log=True,
    reason="frames with a damping ratio of some per cent: 1 / (2 pi ratio) is one to ten",
)


def _wave(view: RecordView, values: Values) -> FloatArray:
    return np.asarray(values[0] * np.sin(2.0 * np.pi * values[1] * view.elapsed + values[2]))


def _on_force(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Constant in force: it grows with the stretch in the true stress."""
    return stress + _wave(view, values) * view.stretch


def _on_stress(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Constant in true stress."""
    return stress + _wave(view, values)


def _on_strain(view: RecordView, values: Values) -> FloatArray:
    """The specimen vibrates and the strain channel does not see it."""
    wave = _wave(view, values)
    return np.asarray(view.true_strain + wave - wave[0])


def _ringing(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Every change of the rate sets off a wave of the force that dies out, as large as the change."""
    size, many, phase, lasting = values
    corners = np.array([0, *view.jumps, len(view) - 1])
    rates = np.diff(view.recorded_strain[corners]) / np.maximum(np.diff(view.time[corners]), 1e-300)
    changes = np.diff(rates, prepend=0.0)
    ring = np.zeros(len(view))
    for corner, change in zip(corners[:-1], changes / max(float(np.max(np.abs(changes))), 1e-300), strict=True):
        periods = many / view.duration * np.maximum(view.time - view.time[corner], 0.0)
        begun = (view.time >= view.time[corner]) * change
        ring += begun * np.exp(-periods / lasting) * np.sin(2.0 * np.pi * periods + phase)
    return stress + size * ring * view.stretch


def _turning(view: RecordView, values: Values) -> FloatArray:
    """A wave and its second harmonic over the elongation, by which a crosshead has travelled; shape (n,)."""
    size, period, phase, second, second_phase = values
    turned = 2.0 * np.pi * np.expm1(view.recorded_strain) / period
    return np.asarray(size * (np.sin(turned + phase) + second * np.sin(2.0 * turned + second_phase)))


def _screw_on_force(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """A screw that runs heavily at one place of each turn: constant in force."""
    return stress + _turning(view, values) * view.stretch


def _screw_on_strain(view: RecordView, values: Values) -> FloatArray:
    """A screw whose thread is uneven: the travel that is recorded is not quite the specimen's; elongations differ."""
    wave = _turning(view, values)
    return true_strain_of(np.exp(view.true_strain) + wave - wave[0])


def _turns(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """The likeliest periods of the residuals, or the prior's centre; sine and cosine, with a small second harmonic."""
    periods = [_SCREW[0].centre]
    if residuals is not None:
        periods = likely_periods([np.expm1(view.sampled(view.recorded_strain)) for view in views], residuals)
    inside = [_SCREW[0].inside(period) for period in periods]
    return [(period, phase, _SECOND, 0.0) for period in inside for phase in (0.0, 0.5 * np.pi)]


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Peaks of the residuals' periodogram, or some cycles over the longest record; sine and cosine."""
    if residuals is None:
        longest = max(view.duration for view in views)
        frequencies = [cycles / longest for cycles in _CYCLES]
    else:
        frequencies = [peak for view, residual in zip(views, residuals, strict=True) for peak in _peaks(view, residual)]
    inside = [_FREQUENCY.inside(frequency) for frequency in frequencies]
    return [(frequency, phase) for frequency in inside for phase in (0.0, 0.5 * np.pi)]


def _rings(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Those of a wave, which lasts as many periods as is usual."""
    longest = max(view.duration for view in views)
    waves = [(_PERIODS.inside(frequency * longest), phase) for frequency, phase in _starts(views, residuals)]
    return [(*wave, _LASTING.centre) for wave in waves]


def _peaks(view: RecordView, residual: FloatArray) -> list[float]:
    """Frequencies [Hz] of the highest peaks, two cycles over the record or more.

    The residual is padded to four times its length: a bin is a quarter of a cycle over the record, and the main lobe
    of the Hann window ends two cycles, eight bins, from a peak (Harris 1978).
    """
    n = len(residual)
    even = np.interp(np.linspace(0.0, view.duration, n), view.sampled(view.elapsed), residual)
    power = np.abs(np.fft.rfft((even - even.mean()) * np.hanning(n), 4 * n)) ** 2
    power[: 4 * 2] = 0.0  # less than two cycles over the record: a trend
    peaks = []
    for _ in range(_PEAKS):
        best = int(np.argmax(power))
        peaks.append(best * (n - 1) / (4.0 * n * view.duration))
        power[max(best - 8, 0) : best + 9] = 0.0
    return peaks


def _parameters(amplitude: EffectParameter) -> tuple[EffectParameter, ...]:
    return (amplitude, _FREQUENCY, _PHASE)


EFFECT = Effect(
    name="periodic_disturbance",
    title="periodic disturbance",
    physics=(
        "A screw, a pump, the mains or a frame that rings adds a wave to the force, the stress or the strain.\n"
        "Amplitude: of the wave; its phase is counted from the start of each record, that of a screw from an "
        "elongation of zero."
    ),
    source=(
        "André et al., Figure 2 (vibration in experiment 1); ASTM E1942; den Hartog 1934, Mechanical Vibrations; "
        "ISO 230-2 (periodic error of a screw)"
    ),
    shows_in=(
        "a wave in the residual; the records of one machine share its frequency, not its phase; that of a screw is a "
        "wave over the elongation, at any speed"
    ),
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "force",
            _parameters(EffectParameter("wave_MPa", "MPa", -20.0, 20.0, 0.2, "some tenths of a MPa")),
            recorded_stress=_on_force,
            starts=_starts,
            sharp="line",
        ),
        Form(
            "stress",
            _parameters(EffectParameter("wave_MPa", "MPa", -20.0, 20.0, 0.2, "some tenths of a MPa")),
            recorded_stress=_on_stress,
            starts=_starts,
            sharp="line",
        ),
        Form(
            "strain",
            _parameters(EffectParameter("wave_strain", "", -0.02, 0.02, 2e-4, "experiment 1 vibrates by 1.5e-4")),
            driving_strain=_on_strain,
            starts=_starts,
            sharp="line",
            converts=False,
        ),
        Form(
            "ringing",
            (
                EffectParameter("wave_MPa", "MPa", -20.0, 20.0, 0.2, "some tenths of a MPa"),
                _PERIODS,
                _PHASE,
                _LASTING,
            ),
            recorded_stress=_ringing,
            starts=_rings,
            placements=("one",),
            sharp="line",
            variant=True,
        ),
        Form(
            "screw_force",
            (EffectParameter("wave_MPa", "MPa", -20.0, 20.0, 0.2, "some tenths of a MPa"), *_SCREW),
            recorded_stress=_screw_on_force,
            starts=_turns,
            sharp="strain_period",
            variant=True,
        ),
        Form(
            "screw_strain",
            (
                EffectParameter(
                    "wave_elongation", "", -0.02, 0.02, 2e-4, "some hundredths of a millimetre of a gauge length"
                ),
                *_SCREW,
            ),
            driving_strain=_screw_on_strain,
            starts=_turns,
            sharp="strain_period",
            variant=True,
        ),
    ),
)
