"""The load cell is not at zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.instants import INSTANT, likely_instants, passed, sudden_instants
from probation.effects.visible import unloads

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


_OFFSET = EffectParameter("offset_MPa", "MPa", -20.0, 20.0, 0.3, "about 1 % of a yield stress")

_TIME = EffectParameter(
    name="settling_time_s",
    unit="s",
    lower=0.1,
    upper=1e5,
    centre=100.0,
    scale=2.0,
    log=True,
    reason="cells creep and warm up within seconds to hours",
)
_PART = EffectParameter(
    "settling_part", "", -1.0, 1.0, 0.4, "what creeps is a part of what is there", starts=(0.3, -0.3)
)


def _offset(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """F / A_0 more in the force is that times the stretch in the true stress."""
    return stress + values[0] * view.stretch


def _jump(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same from an instant on: one part of every record."""
    return stress + values[0] * passed(view, values[1]) * view.stretch


def _settling(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same at the start; a part b of it goes as 1 - e^(-t/T), or as much is added (b < 0)."""
    offset = values[0] * (1.0 + values[2] * np.expm1(-view.elapsed / values[1]))
    return np.asarray(stress + offset * view.stretch)


def _durations(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Time constants [s]: a tenth of the shortest record, half the median one, half the longest."""
    durations = [view.duration for view in views]
    times = [0.1 * min(durations), 0.5 * float(np.median(durations)), 0.5 * max(durations)]
    return [(_TIME.inside(time), part) for time in times for part in _PART.starts]


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Where the strain is taken back, what the material does at a reversal would be taken for a jump."""
    if unloads(views):
        return [(instant,) for instant in sudden_instants(views, residuals, near_jumps=False)]
    return [(instant,) for instant in likely_instants(views, residuals)]


EFFECT = Effect(
    name="force_offset",
    title="offset of the force",
    physics=(
        "The load cell reads a constant force too much, all along or from an instant on (another range of the "
        "amplifier, a clamp that snaps); it may settle or grow (a cell that creeps after a load, or warms up). In the "
        "true stress it grows with the stretch.\n"
        "Amplitude: that force over the initial section, at the start."
    ),
    source="ISO 7500-1 (calibration of force-measuring systems); OIML R 60 (creep, and temperature of the zero)",
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
            variant=True,
        ),
        Form(
            "settling",
            (_OFFSET, _TIME, _PART),
            recorded_stress=_settling,
            starts=_durations,
            variant=True,
        ),
    ),
)
