"""The elongation is wrong by a factor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.catalogue.strain_offset import true_strain_of
from probation.effects.effect import Effect, EffectParameter, Form, Values

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def _factor(view: RecordView, values: Values) -> FloatArray:
    """The specimen's elongation is the recorded one over 1 + a."""
    return true_strain_of(1.0 + np.expm1(view.true_strain) / (1.0 + values[0]))


def _true_strain(view: RecordView, values: Values) -> FloatArray:
    """The specimen's true strain is the recorded one over 1 + a, as if it had been a rate times the time."""
    return np.asarray(view.true_strain / (1.0 + values[0]))


def _bending(view: RecordView, values: Values) -> FloatArray:
    """In proportion to a power of the recorded elongation: nothing at the start, a at its largest."""
    elongation = np.expm1(view.true_strain)
    largest = float(np.max(np.abs(np.expm1(view.recorded_strain))))
    used = np.abs(elongation) / max(largest, 1e-300)
    return true_strain_of(1.0 + elongation / (1.0 + values[0] * used ** values[1]))


_SIZE = "gauge lengths and extensometers to 1 or 2 %, dumb-bells and clips on soft strips to some per cent"

_ERROR = EffectParameter("strain_gain_error", "", -0.5, 0.5, 0.02, _SIZE)

_FACTOR = Form("factor", (_ERROR,), driving_strain=_factor)

EFFECT = Effect(
    name="strain_gain",
    title="gain of the strain",
    physics=(
        "The gauge length is not what was typed in, the extensometer's sensitivity is wrong by a factor, or its "
        "characteristic bends; so does the effective gauge length of a dumb-bell. Or the true strain is a rate that "
        "was not kept, times the time.\n"
        "Amplitude: relative excess of the recorded elongation or true strain, or at its largest. In all records "
        "alike a factor is near one of E_u and G. The true stress was made of it, or (measured section) not."
    ),
    source="ISO 9513 (extensometers); ISO 527-1 (gauge length); ASTM D638 (dumb-bells)",
    shows_in="one record compared with others: it begins with another slope and flows at the same stress",
    kind="rig",
    forms=(
        _FACTOR,
        _FACTOR.measured_section(),
        Form("true_strain", (_ERROR,), driving_strain=_true_strain, variant=True),
        Form(
            "bending",
            (
                EffectParameter("strain_gain_bend", "", -0.5, 0.5, 0.02, _SIZE),
                EffectParameter(
                    name="power",
                    unit="",
                    lower=0.3,
                    upper=4.0,
                    centre=1.0,
                    scale=0.5,
                    log=True,
                    reason="1 for the square of the elongation in a characteristic, 2 for its cube",
                ),
            ),
            driving_strain=_bending,
            variant=True,
        ),
    ),
)
