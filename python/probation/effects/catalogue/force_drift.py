"""The load cell's zero wanders."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def _over_record(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """From nothing at the start to a at the end, in nominal stress."""
    return stress + values[0] * (view.elapsed / view.duration) * view.stretch


def _in_time(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """One rate for all records, in nominal stress."""
    return stress + values[0] * view.elapsed * view.stretch


EFFECT = Effect(
    name="force_drift",
    title="drift of the force",
    physics=(
        "The zero of the load cell wanders steadily while the test runs (warming electronics).\n"
        "Amplitude: force over initial section, by the end of a record or per second."
    ),
    source="ISO 7500-1 (calibration of force-measuring systems)",
    shows_in="long records; within one record at constant rate it resembles hardening",
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "over_record",
            (EffectParameter("drift_MPa", "MPa", -20.0, 20.0, 0.3, "about 1 % of a yield stress"),),
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
    ),
)
