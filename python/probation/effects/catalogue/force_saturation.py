"""The load cell's range ends."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import StartsHook
    from probation.effects.record_view import RecordView


_LIMIT = EffectParameter("inverse_limit_per_MPa", "1/MPa", 0.0, 1.0, 0.03, "a limit of some ten MPa of nominal stress")
_ROUNDING = 0.02
"""Usual width of the bend over the limit [-]: some per cent of a cell's range."""
_ROUNDINGS = (_ROUNDING, 0.2)
"""Widths from which searches begin."""
_SHARPNESSES = (5.0, 12.0)
"""Powers from which searches begin."""


def _saturate(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The recorded nominal stress does not exceed 1 / a, in tension and compression."""
    if values[0] <= 0.0:
        return stress
    limit = view.stretch / values[0]
    return np.clip(stress, -limit, limit)


def _bend(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The reading bends into its limit L along a hyperbola of the width w L; it is true for small forces.

    With u the force over L, h(u) = (u + sqrt(1 + w^2) - sqrt((1 - u)^2 + w^2)) / 2 has the slope h'(0) at rest and the
    end h_e = (1 + sqrt(1 + w^2)) / 2; the reading is L h(u h_e / h'(0)) / h_e.
    """
    if values[0] <= 0.0:
        return stress
    root = float(np.hypot(1.0, values[1]))
    end, slope = 0.5 * (1.0 + root), 0.5 * (1.0 + 1.0 / root)
    used = np.abs(stress) * values[0] / view.stretch * end / slope
    bent = 0.5 * (used + root - np.hypot(1.0 - used, values[1])) / end
    return np.asarray(np.sign(stress) * bent * view.stretch / values[0])


def _compress(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The reading is L u / (1 + |u|^p)^(1/p), u the force over its limit L (Rapp 1991)."""
    if values[0] <= 0.0:
        return stress
    used = np.abs(stress) * values[0] / view.stretch
    # In terms of the smaller one of u and 1/u: no power overflows.
    less, more = np.minimum(used, 1.0), np.maximum(used, 1.0)
    return np.asarray(stress / more * (1.0 + (less / more) ** values[1]) ** (-1.0 / values[1]))


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Limits at 99.5 and at 90 % of the largest nominal stress that was recorded: hard, and bent into."""
    largest = max(float(np.max(np.abs(view.nominal_data))) for view in views)
    return [(1.0 / (part * largest),) for part in (0.995, 0.9)] if largest > 0.0 else []


def _soft_starts(softnesses: tuple[float, ...]) -> StartsHook:
    """The same limits, each with every one of these softnesses."""

    def starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
        return [(*start, softness) for start in _starts(views, residuals) for softness in softnesses]

    return starts


EFFECT = Effect(
    name="force_saturation",
    title="saturation of the force",
    physics=(
        "The load cell or its amplifier ends at a largest force: beyond it the reading stands still.\n"
        "Amplitude: one over that force per initial section; 0 means no limit."
    ),
    source=(
        "ASTM E1942 (data acquisition in mechanical testing); Rapp 1991, Proc. 2nd European Conf. Satellite Comm., 179 "
        "(amplifiers that saturate softly)"
    ),
    shows_in="records whose force reaches a plateau, the same in all of them but for their sections",
    kind="rig",
    coordinate="force",
    forms=(
        Form(
            "clip",
            (_LIMIT,),
            recorded_stress=_saturate,
            starts=_starts,
            threshold=True,
        ),
        Form(
            "bend",
            (
                _LIMIT,
                EffectParameter(
                    name="rounding",
                    unit="",
                    lower=1e-3,
                    upper=1.0,
                    centre=_ROUNDING,
                    scale=1.2,
                    log=True,
                    starts=_ROUNDINGS,
                    reason="an amplifier is linear up to some per cent of its range, a poor one up to half of it",
                ),
            ),
            recorded_stress=_bend,
            starts=_soft_starts(_ROUNDINGS),
            threshold=True,
        ),
        Form(
            "compression",
            (
                _LIMIT,
                EffectParameter(
                    name="sharpness",
                    unit="",
                    lower=4.0,
                    upper=60.0,
                    centre=8.0,
                    scale=0.6,
                    log=True,
                    starts=_SHARPNESSES,
                    reason="an amplifier that is linear up to a half of its range has 6; a limiter has many",
                ),
            ),
            recorded_stress=_compress,
            starts=_soft_starts(_SHARPNESSES),
            threshold=True,
            variant=True,
        ),
    ),
)
