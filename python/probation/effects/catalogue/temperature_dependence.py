"""The stress depends on the temperature of the test."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible_temperature import changes_without_work, starts_differ
from probation.effects.warming import HARDENING_PART
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_ZERO = 273.15
"""0 °C [K]."""
_SOFTENING = EffectParameter(
    name="softening_per_degC",
    unit="1/°C",
    lower=0.0,
    upper=1.0,
    scale=0.1,
    reason="-d ln tau_max / dT; an activation energy of 70 kJ/mol at room temperature gives 0.1, a glass more",
)
_MODULUS = EffectParameter(
    name="modulus_part",
    unit="",
    lower=-0.1,
    upper=0.5,
    centre=0.0,
    scale=0.05,
    reason="-d ln E_u / dT over the softening: glasses lose 0.1 to 0.5 % per degree",
)
_WLF = EffectParameter(
    name="wlf_c2_degC",
    unit="°C",
    lower=20.0,
    upper=500.0,
    centre=52.0,
    scale=0.7,
    log=True,
    starts=(52.0,),
    reason="51.6 °C at the glass transition, more above it (Williams, Landel and Ferry)",
)
_LOSS = EffectParameter(
    name="stress_loss_per_degC",
    unit="1/°C",
    lower=-0.02,
    upper=0.1,
    scale=0.01,
    reason="-d ln stress / dT: a yield stress falls by about 1 % per degree",
)


def _arrhenius(view: RecordView, values: Values) -> Modification | None:
    """tau_max exp(a T_0^2 (1/T - 1/T_0)), in K; G exp(-b a (T - T_0)), E_u exp(-c a (T - T_0))."""
    if (warmer := view.warmer_than_reference) is None or view.reference_temperature is None:
        return None
    softening, hardening, modulus = values
    kelvin = view.reference_temperature + _ZERO
    return _at(-softening * warmer / (1.0 + warmer / kelvin), softening * warmer, hardening, modulus)


def _wlf(view: RecordView, values: Values) -> Modification | None:
    """tau_max exp(-a (T - T_0) / (1 + (T - T_0) / c_2)); G exp(-b a (T - T_0)), E_u exp(-c a (T - T_0))."""
    if (warmer := view.warmer_than_reference) is None:
        return None
    softening, hardening, modulus, c2 = values
    # Farther below than half of c2 the shift goes on straight: WLF ends at the glass transition.
    low = np.maximum(warmer, -0.5 * c2)
    shift = -softening * (low / (1.0 + low / c2) + 4.0 * np.minimum(warmer + 0.5 * c2, 0.0))
    return _at(shift, softening * warmer, hardening, modulus)


def _at(log_time: FloatArray, softened: FloatArray, hardening: float, modulus: float) -> Modification:
    return Modification(
        relaxation_time_factor=np.exp(np.clip(log_time, -50.0, 50.0)),
        hardening_factor=np.exp(-hardening * softened),
        unrelaxed_modulus_factor=np.exp(-modulus * softened),
    )


def _of_the_stress(view: RecordView, values: Values) -> Modification | None:
    """E_u and G alike exp(-a (T - T_0)), tau_max as it is: the stress is scaled."""
    if (warmer := view.warmer_than_reference) is None:
        return None
    factor = np.exp(-values[0] * warmer)
    return Modification(unrelaxed_modulus_factor=factor, hardening_factor=factor)


def _differs(views: Sequence[RecordView]) -> bool:
    return starts_differ(views) or changes_without_work(views)


EFFECT = Effect(
    name="temperature_dependence",
    title="temperature dependence",
    physics=(
        "Relaxation is activated by heat and the network is entropic: tau_max, G and E_u follow the temperature.\n"
        "Amplitude: -d ln tau_max / dT (or of the stress) at T_0, the mean of the temperatures at which records start."
    ),
    source=(
        "Arrhenius; Williams, Landel & Ferry 1955, J. Am. Chem. Soc. 77, 3701; Na et al. 2007, J. Phys. Chem. B 111, "
        "13206"
    ),
    shows_in="records at different temperatures, declared or measured, where every record has one",
    kind="material",
    coordinate="temperature",
    forms=(
        Form("arrhenius", (_SOFTENING, HARDENING_PART, _MODULUS), modification=_arrhenius, needs=_differs),
        Form("wlf", (_SOFTENING, HARDENING_PART, _MODULUS, _WLF), modification=_wlf, needs=_differs),
        Form("of_the_stress", (_LOSS,), modification=_of_the_stress, needs=_differs),
    ),
)
