"""The specimen is under stress when the record starts."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import InitialStress, Modification

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

_AMPLITUDE = EffectParameter(
    "prestress_MPa", "MPa", -20.0, 20.0, 0.5, "clamping and straightening take some per cent of a yield stress"
)


def _fresh(view: RecordView, values: Values) -> Modification:
    """As after a sudden stretch: every mode carries its weight's part."""
    return Modification(initial_stress=InitialStress(values[0]))


def _held(view: RecordView, values: Values) -> Modification:
    """As after a dwell at that stretch: the fast modes have relaxed."""
    return Modification(initial_stress=InitialStress(values[0], values[1]))


EFFECT = Effect(
    name="prestress",
    title="prestress",
    physics=(
        "Clamping or straightening loads the specimen before the record starts; that stress then relaxes.\n"
        "Amplitude: stress at the first sample, fresh or held for some time."
    ),
    source="ISO 527-1, section 9.4 (prestresses)",
    shows_in="the start of a record, for about the longest relaxation time",
    kind="rig",
    coordinate="log_time",
    forms=(
        Form("fresh", (_AMPLITUDE,), modification=_fresh),
        Form(
            "held",
            (
                _AMPLITUDE,
                EffectParameter(
                    name="held_over_tau_max",
                    unit="",
                    lower=1e-4,
                    upper=3.0,
                    centre=0.1,
                    scale=1.5,
                    log=True,
                    starts=(0.02, 0.3),
                    reason="seconds to minutes between clamping and starting",
                ),
            ),
            modification=_held,
        ),
    ),
)
