"""The load cell reads more on the way down."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible import unloads

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_SIZE = EffectParameter(
    name="reversibility_error",
    unit="",
    lower=0.0,
    upper=0.3,
    scale=0.01,
    reason="of the largest force; ISO 7500-1 allows 0.75 % in class 0.5, 1.5 % in class 1",
)


def _loop(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """On the way down from the largest force so far M a force F reads F + 4 a F (1 - F / M); exact at M and at 0."""
    force = np.maximum(stress / view.stretch, 0.0)
    largest = np.maximum.accumulate(force)
    part = np.divide(force, largest, out=np.ones_like(force), where=largest > 0.0)
    return np.asarray(stress + 4.0 * values[0] * force * (1.0 - part) * view.stretch)


def _friction(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The reading stands still until the force has fallen by w, then follows w above it (play); w is a times the
    record's largest force.
    """
    force = stress / view.stretch
    width = values[0] * float(np.max(np.abs(view.nominal_data)))
    reading, read = float(force[0]), []
    for now in force.tolist():
        reading = max(now, min(now + width, reading))
        read.append(reading)
    return np.array(read) * view.stretch


EFFECT = Effect(
    name="cell_hysteresis",
    title="hysteresis of the load cell",
    physics=(
        "The load cell, or friction in the load train, reads a falling force as larger than it is.\n"
        "Amplitude: largest difference between the ways down and up, over the largest force."
    ),
    source="ISO 376 and ISO 7500-1 (relative reversibility error); Krasnosel'skii & Pokrovskii 1989 (play)",
    shows_in="unloading, where the force falls by a good part",
    kind="rig",
    coordinate="force",
    forms=(
        Form("loop", (_SIZE,), recorded_stress=_loop, needs=unloads),
        Form("friction", (_SIZE,), recorded_stress=_friction, needs=unloads),
    ),
    odds=0.3,
)
