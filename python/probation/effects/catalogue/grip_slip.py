"""The specimen slips in its grips."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_INSTANTS = tuple(np.linspace(0.05, 0.95, 19).tolist())
_DURATION = 0.004
_PARAMETERS = (
    EffectParameter("slip_strain", "", -0.2, 0.2, 0.005, "a slip of a tenth of a millimetre over a gauge of 20 mm"),
    EffectParameter(
        name="instant_of_record",
        unit="",
        lower=0.0,
        upper=1.0,
        centre=0.5,
        scale=float("inf"),
        starts=_INSTANTS,
        reason="at any time",
    ),
    EffectParameter(
        name="duration_of_record",
        unit="",
        lower=0.0,
        upper=0.04,
        centre=0.0,
        scale=0.008,
        starts=(_DURATION,),
        reason="jaws let go at once, but the channels follow within some samples",
    ),
)


def _slip(view: RecordView, values: Values) -> FloatArray:
    """Around the instant (a fraction of the record) the specimen loses a; within its duration, a sample at least."""
    width = view.stride * float(np.median(np.diff(view.time))) + values[2] * view.duration
    passed = np.clip((view.elapsed - values[1] * view.duration) / width + 0.5, 0.0, 1.0)
    return view.true_strain - values[0] * passed**2 * (3.0 - 2.0 * passed)


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """An even grid and, with residuals, the two instants where they jump most."""
    found = list(_INSTANTS)
    for view, residual in zip(views, residuals or (), strict=False):
        window = max(len(residual) // 100, 2)
        means = np.convolve(residual, np.ones(window) / window, mode="valid")
        jump = np.abs(means[window:] - means[:-window])
        for _ in range(2):
            best = int(np.argmax(jump))
            instant = view.sampled(view.elapsed)[best + window] / view.duration
            found.append(float(np.clip(instant, 0.0, 1.0)))
            jump[max(best - 2 * window, 0) : best + 2 * window] = 0.0
    return [(instant, _DURATION) for instant in found]


EFFECT = Effect(
    name="grip_slip",
    title="slip in the grips",
    physics=(
        "The specimen slips in its grips at some instant: the recorded strain goes on, the specimen's jumps back.\n"
        "Amplitude: recorded strain that is lost. The true stress was made of the recorded strain, or measured apart."
    ),
    source="ISO 527-1, section 5.1.3 (grips)",
    shows_in="one record, from one instant on: the stress drops and recovers",
    kind="rig",
    forms=(
        Form("recorded_section", _PARAMETERS, driving_strain=_slip, starts=_starts, placements=("one",), sharp="step"),
        Form(
            "measured_section",
            _PARAMETERS,
            driving_strain=_slip,
            starts=_starts,
            converts=False,
            placements=("one",),
            sharp="step",
        ),
    ),
)
