"""The load cell's range ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.gap.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.gap.record_view import RecordView


def _saturate(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The recorded nominal stress does not exceed 1 / a, in tension and compression."""
    if values[0] <= 0.0:
        return stress
    limit = view.stretch / values[0]
    return np.clip(stress, -limit, limit)


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Just below, and well below, the largest force that was recorded."""
    largest = max(float(np.max(np.abs(view.nominal_data))) for view in views)
    return [(1.0 / (part * largest),) for part in (0.995, 0.9)] if largest > 0.0 else []


EFFECT = Effect(
    name="force_saturation",
    title="saturation of the force",
    physics=(
        "The load cell or its amplifier ends at a largest force: beyond it the reading stands still.\n"
        "Amplitude: one over that force per initial section; 0 means no limit."
    ),
    source="ASTM E1942 (data acquisition in mechanical testing)",
    shows_in="records whose force reaches a plateau, the same in all of them",
    kind="rig",
    forms=(
        Form(
            "clip",
            (
                EffectParameter(
                    "inverse_limit_per_MPa", "1/MPa", 0.0, 1.0, 0.03, "a limit of some ten MPa of nominal stress"
                ),
            ),
            recorded_stress=_saturate,
            starts=_starts,
            threshold=True,
        ),
    ),
)
