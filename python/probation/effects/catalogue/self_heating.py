"""Plastic work warms the specimen."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.warming import SOFTENING_PER_DEGREE
from probation.law.modification import Modification, SelfHeating

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

_HEATING = EffectParameter(
    name="heating_degC_per_MPa",
    unit="°C/MPa",
    lower=0.0,
    upper=1.0,
    scale=0.3,
    reason="all work into heat, adiabatic: 1/(density x heat capacity), 0.5 in polyethylene",
)
_COOLING = EffectParameter(
    name="cooling_rate_per_s",
    unit="1/s",
    lower=1e-5,
    upper=1.0,
    centre=4e-3,
    scale=1.5,
    log=True,
    starts=(5e-4, 5e-3, 5e-2),
    reason="2 h / (density x heat capacity x thickness): 4 mm in still air",
)
_HARDENING_LOSS = EffectParameter(
    name="hardening_loss_per_degC",
    unit="1/°C",
    lower=0.0,
    upper=0.02,
    centre=0.004,
    scale=0.004,
    reason="G of polyethylene falls by about 0.5 % per degree",
)


def _warm(view: RecordView, values: Values) -> Modification:
    """Temperature T' = heating x plastic power - cooling T; tau_max e^(-0.1 T), G e^(-loss T)."""
    heating, cooling, hardening_loss = values
    return Modification(feedbacks=(SelfHeating(heating, cooling, SOFTENING_PER_DEGREE, hardening_loss),))


EFFECT = Effect(
    name="self_heating",
    title="self-heating",
    physics=(
        "Plastic work turns into heat faster than it leaves: the specimen warms, relaxes faster and hardens less.\n"
        f"Amplitude: warming per plastic work; relaxation times fall by {100 * SOFTENING_PER_DEGREE:.0f} % per degree."
    ),
    source="Taylor & Quinney 1934; Arruda, Boyce & Jayachandran 1995, Mech. Mater. 19, 193",
    shows_in="fast records at large strains, against slow ones that stay cool",
    kind="material",
    forms=(Form("adiabatic_to_cooled", (_HEATING, _COOLING, _HARDENING_LOSS), modification=_warm),),
)
