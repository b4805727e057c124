"""Plastic work warms the specimen."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import running_integral
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.maxwell_element import maxwell_element
from probation.effects.visible_temperature import all_measured, warms_by_work
from probation.effects.warming import SOFTENING
from probation.law.kinematics import haward_thackray_strain
from probation.law.modification import Modification, SelfHeating

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
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
_LEAST_STRESS = 0.02
"""Part of the stress [-] that is left at any temperature: the line that falls with the work ends above zero."""

_MEASURED_SOFTENING = EffectParameter(
    name="softening_per_degC",
    unit="1/°C",
    lower=0.0,
    upper=0.5,
    scale=0.1,
    reason="-d ln tau_max / dT; an activation energy of 70 kJ/mol at room temperature gives 0.1",
)
_HARDENING_PART = EffectParameter(
    name="hardening_part",
    unit="",
    lower=0.0,
    upper=0.5,
    centre=0.05,
    scale=0.05,
    reason="-d ln G / dT over the softening: G of polyethylene falls by about 0.5 % per degree",
)
_MEASURED = (_MEASURED_SOFTENING, _HARDENING_PART)
_DELAY = EffectParameter(
    name="delay_s",
    unit="s",
    lower=0.3,
    upper=300.0,
    centre=10.0,
    scale=1.0,
    log=True,
    starts=(3.0, 20.0),
    reason="of a thermocouple in air, or from the middle of 4 mm of polymer to its surface: seconds to half a minute",
)
_MEASURED_LATE = (*_MEASURED, _DELAY)
_LOSS = EffectParameter(
    name="stress_loss_per_MPa",
    unit="1/MPa",
    lower=0.0,
    upper=0.1,
    scale=0.005,
    reason="0.5 °C per MPa of work times 1 % per degree, as a yield stress falls",
)
_TIME_LOSS = EffectParameter(
    name="log_time_loss_per_MPa",
    unit="1/MPa",
    lower=0.0,
    upper=0.5,
    scale=0.05,
    reason="0.5 °C per MPa of heat times 0.1 per degree, an activation energy of 70 kJ/mol",
)
_LEVELLING = EffectParameter(
    name="levelling_heat_MPa",
    unit="MPa",
    lower=150.0,
    upper=5000.0,
    centre=600.0,
    scale=0.7,
    log=True,
    reason="that warms by 296 K (Arrhenius), 0.5 °C per MPa; by C2 of some 100 K (Williams, Landel and Ferry)",
)
_STORED_HARDENING = EffectParameter(
    name="stored_hardening_MPa",
    unit="MPa",
    lower=0.0,
    upper=20.0,
    scale=2.0,
    reason="all work into heat: 0; all but the network's: G, some MPa in polyethylene",
)
_STORED_COMPLIANCE = EffectParameter(
    name="stored_compliance_per_MPa",
    unit="1/MPa",
    lower=0.0,
    upper=0.01,
    scale=0.001,
    reason="1/E_u of a polymer; more where stresses differ from mode to mode",
)


def _warm(view: RecordView, values: Values) -> Modification:
    """Temperature T' = heating x plastic power - cooling T; tau_max e^(-softening T), G e^(-loss T)."""
    heating, cooling, softening, hardening_loss = values
    return Modification(feedbacks=(SelfHeating(heating, cooling, softening, hardening_loss),))


def _as_measured(view: RecordView, values: Values) -> Modification | None:
    """T is the measured temperature less that at the start; tau_max e^(-a T), G e^(-b a T)."""
    return None if view.measured_rise is None else _warmed(view.measured_rise, values)


def _as_measured_late(view: RecordView, values: Values) -> Modification | None:
    """The same, the measured rise being late by a first-order lag: T = T_m + delay T_m'."""
    return None if (rise := _before_the_delay(view, values[2])) is None else _warmed(rise, values)


def _warmed(rise: FloatArray, values: Values) -> Modification:
    softening, hardening = values[:2]
    return Modification(
        relaxation_time_factor=np.exp(-softening * rise), hardening_factor=np.exp(-hardening * softening * rise)
    )


def _before_the_delay(view: RecordView, delay: float) -> FloatArray | None:
    """The rise (n,) [°C] that a thermometer follows with a time constant; None where it was not measured."""
    rise = view.measured_rise
    return None if rise is None else rise + delay * np.gradient(rise, view.time)


def _thermally_activated(view: RecordView, values: Values) -> Modification:
    """tau_max e^(-a w / (1 + w / w_l)), G e^(-b a w); w the heat of the recorded work less what has cooled off.

    In terms of the warming T ~ w the exponent is that of Arrhenius, H/R (1/T_0 - 1/(T_0 + T)), if w_l warms by T_0, and
    that of Williams, Landel and Ferry if it warms by their C2.
    """
    loss, cooling, levelling, hardening, stored_hardening, stored_compliance = values
    heat = np.maximum(_kept_heat(view, cooling, stored_hardening, stored_compliance), 0.0)
    return Modification(
        relaxation_time_factor=np.exp(-loss * heat / (1.0 + heat / levelling)),
        hardening_factor=np.exp(-hardening * loss * heat),
    )


def _of_the_stress(view: RecordView, values: Values) -> Modification:
    """E_u and G alike 1 - a w, tau_max as it is; w the recorded work less what has cooled off (Johnson and Cook)."""
    factor = np.maximum(1.0 - values[0] * _kept_work(view, values[1]), _LEAST_STRESS)
    return Modification(unrelaxed_modulus_factor=factor, hardening_factor=factor)


def _not_all_measured(views: Sequence[RecordView]) -> bool:
    return not all_measured(views)


def _warming(view: RecordView, values: Values) -> FloatArray:
    """The measured rise [°C]; else what the recorded work brought, less what has cooled off, per heating [MPa]."""
    if len(values) == len(_MEASURED) and view.measured_rise is not None:
        return view.measured_rise
    if len(values) == len(_MEASURED_LATE) and (rise := _before_the_delay(view, values[2])) is not None:
        return rise
    return _kept_work(view, values[1])


def _kept_work(view: RecordView, cooling: float) -> FloatArray:
    """The recorded work so far, less what has cooled off; shape (n,) [MPa]."""
    return _kept_heat(view, cooling, 0.0, 0.0)


def _kept_heat(view: RecordView, cooling: float, stored_hardening: float, stored_compliance: float) -> FloatArray:
    """The same of the work that is not stored in the network, nor as elastic energy; shape (n,) [MPa]."""
    stress = view.smooth_true_data
    flow = stress - stored_hardening * haward_thackray_strain(view.true_strain)
    work = running_integral(flow, view.true_strain)
    return maxwell_element(view.time, work - 0.5 * stored_compliance * stress**2, 1.0 / cooling)


EFFECT = Effect(
    name="self_heating",
    title="self-heating",
    physics=(
        "Plastic work turns into heat faster than it leaves: the specimen warms, relaxes faster and hardens less.\n"
        "Amplitude: warming per plastic work; where every record has its measured temperature, that drives the law, "
        "and the amplitude is the loss of ln tau_max per degree; late: of a thermometer that lags behind. Thermally "
        "activated: that per heat of the recorded work. Of the stress: its relative loss per work."
    ),
    source=(
        "Taylor & Quinney 1934; Arruda, Boyce & Jayachandran 1995, Mech. Mater. 19, 193; Johnson & Cook 1983 (the "
        "stress falls in proportion to the warming); Arrhenius 1889, Williams, Landel & Ferry 1955, J. Am. Chem. Soc. "
        "77, 3701 (times over temperature); Boyce, Parks & Argon 1988, Mech. Mater. 7, 15 (heat is the work of the "
        "stress beyond the network's); IEC 60751 (response time of thermometers)"
    ),
    shows_in="fast records at large strains, against slow ones that stay cool; a measured temperature judges it",
    kind="material",
    coordinate=_warming,
    forms=(
        Form(
            "adiabatic_to_cooled",
            (_HEATING, _COOLING, SOFTENING, _HARDENING_LOSS),
            modification=_warm,
            needs=_not_all_measured,
        ),
        Form(
            "thermally_activated",
            (_TIME_LOSS, _COOLING, _LEVELLING, _HARDENING_PART, _STORED_HARDENING, _STORED_COMPLIANCE),
            modification=_thermally_activated,
            needs=_not_all_measured,
            variant=True,
        ),
        Form("of_the_stress", (_LOSS, _COOLING), modification=_of_the_stress, needs=_not_all_measured, variant=True),
        Form("as_measured", _MEASURED, modification=_as_measured, needs=warms_by_work),
        Form("measured_late", _MEASURED_LATE, modification=_as_measured_late, needs=warms_by_work, variant=True),
    ),
)
