"""The load cell's zero wanders."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


_DRIFT = EffectParameter("drift_MPa", "MPa", -20.0, 20.0, 0.3, "about 1 % of a yield stress")


def _over_record(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """From nothing at the start to a at the end, in nominal stress."""
    return stress + values[0] * (view.elapsed / view.duration) * view.stretch


def _in_time(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """One rate for all records, in nominal stress."""
    return stress + values[0] * view.elapsed * view.stretch


def _logarithmic(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """As ln(1 + t / t_0), t_0 a fraction of the record: from nothing to a at the end, in nominal stress."""
    part = np.log1p(view.elapsed / (values[1] * view.duration)) / np.log1p(1.0 / values[1])
    return np.asarray(stress + values[0] * part * view.stretch)


def _settling(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """As 1 - e^(-t / T), T a fraction of the record: from nothing to a at the end, in nominal stress."""
    part = np.expm1(-view.elapsed / (values[1] * view.duration)) / np.expm1(-1.0 / values[1])
    return np.asarray(stress + values[0] * part * view.stretch)


EFFECT = Effect(
    name="force_drift",
    title="drift of the force",
    physics=(
        "The zero of the load cell wanders while the test runs: steadily (warming electronics), or ever more slowly "
        "(electronics that settle, creep of the cell).\n"
        "Amplitude: force over initial section, by the end of a record or per second."
    ),
    source="ISO 7500-1 (calibration of force-measuring systems); OIML R 60 (creep); Guiu & Pratt 1964 (logarithmic)",
    shows_in="long records; within one record at constant rate it resembles hardening",
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "over_record",
            (_DRIFT,),
            recorded_stress=_over_record,
        ),
        Form(
            "in_time",
            (
                EffectParameter(
                    "drift_MPa_per_s", "MPa/s", -1.0, 1.0, 1e-3, "about 1 % of a yield stress within five minutes"
                ),
            ),
            recorded_stress=_in_time,
            placements=("all",),
        ),
        Form(
            "logarithmic",
            (
                _DRIFT,
                EffectParameter(
                    name="time_of_record",
                    unit="",
                    lower=1e-3,
                    upper=3.0,
                    centre=0.05,
                    scale=1.0,
                    log=True,
                    starts=(0.03,),
                    reason="half an hour of warming up, or less; with much more it is steady",
                ),
            ),
            recorded_stress=_logarithmic,
            variant=True,
        ),
        Form(
            "settling",
            (
                _DRIFT,
                EffectParameter(
                    name="time_constant_of_record",
                    unit="",
                    lower=0.01,
                    upper=3.0,
                    centre=0.3,
                    scale=0.8,
                    log=True,
                    starts=(0.1, 0.4),
                    reason="a cell comes to a temperature by one time constant; with much more it is steady",
                ),
            ),
            recorded_stress=_settling,
            variant=True,
        ),
    ),
)
