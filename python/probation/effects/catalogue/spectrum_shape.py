"""The weights of the modes are not proportional to the root of their times."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView


def _weights(view: RecordView, values: Values) -> Modification:
    """p_j proportional to tau_j^(1/2 + a), sum 1."""
    return Modification(weight_exponent=values[0])


EFFECT = Effect(
    name="spectrum_shape",
    title="another shape of the spectrum",
    physics=(
        "Equipartition of entropy production gives weights that follow the root of the relaxation time, eq. (5).\n"
        "Amplitude: what must be added to the exponent 1/2; positive means more slow modes."
    ),
    source="André et al., eq. (5); Cunat 2001, Mech. Time-Depend. Mater. 5, 39",
    shows_in="every record with fast and slow parts: onset, rate jumps, dwells",
    kind="material",
    coordinate="log_time",
    forms=(
        Form(
            "power",
            (
                EffectParameter(
                    name="spectrum_exponent_change",
                    unit="",
                    lower=-0.5,
                    upper=1.0,
                    scale=0.1,
                    reason="measured spectra of polymers have slopes of 0.3 to 0.7 in log-log axes",
                ),
            ),
            modification=_weights,
        ),
    ),
)
