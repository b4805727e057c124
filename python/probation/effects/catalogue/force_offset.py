"""The load cell is not at zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def _offset(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """F / A_0 more in the force is that times the stretch in the true stress."""
    return stress + values[0] * view.stretch


EFFECT = Effect(
    name="force_offset",
    title="offset of the force",
    physics=(
        "The load cell reads a constant force too much; in the true stress it grows with the stretch.\n"
        "Amplitude: that force over the initial section."
    ),
    source="ISO 7500-1 (calibration of force-measuring systems)",
    shows_in="the start of a record, where the stress ought to be zero, and its stretched end",
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "constant",
            (EffectParameter("offset_MPa", "MPa", -20.0, 20.0, 0.3, "about 1 % of a yield stress"),),
            recorded_stress=_offset,
        ),
    ),
)
