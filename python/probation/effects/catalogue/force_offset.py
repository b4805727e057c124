"""The load cell is not at zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.instants import INSTANT, likely_instants, passed
from probation.effects.visible import unloads

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


_OFFSET = EffectParameter("offset_MPa", "MPa", -20.0, 20.0, 0.3, "about 1 % of a yield stress")


def _offset(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """F / A_0 more in the force is that times the stretch in the true stress."""
    return stress + values[0] * view.stretch


def _jump(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same from an instant on: one part of every record."""
    return stress + values[0] * passed(view, values[1]) * view.stretch


def _never_taken_back(views: Sequence[RecordView]) -> bool:
    """Where the strain is taken back, what the material does at the reversal would be taken for a jump."""
    return not unloads(views)


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    return [(instant,) for instant in likely_instants(views, residuals)]


EFFECT = Effect(
    name="force_offset",
    title="offset of the force",
    physics=(
        "The load cell reads a constant force too much, all along or from an instant on (another range of the "
        "amplifier, a clamp that snaps); in the true stress it grows with the stretch.\n"
        "Amplitude: that force over the initial section."
    ),
    source="ISO 7500-1 (calibration of force-measuring systems)",
    shows_in="the start of a record, where the stress ought to be zero, and its stretched end; or a jump",
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "constant",
            (_OFFSET,),
            recorded_stress=_offset,
        ),
        Form(
            "jump",
            (_OFFSET, INSTANT),
            recorded_stress=_jump,
            starts=_starts,
            sharp="step",
            needs=_never_taken_back,
            variant=True,
        ),
    ),
)
