"""How a law answers to a change of temperature that was not measured."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import EffectParameter
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray

SOFTENING = EffectParameter(
    name="softening_per_degC",
    unit="1/°C",
    lower=0.01,
    upper=0.5,
    centre=0.1,
    scale=0.5,
    log=True,
    reason="-d ln tau_max / dT; 70 kJ/mol at room temperature; only its product with the warming enters",
)
"""An activation energy of 70 kJ/mol is that of the alpha relaxation of polyethylene within its scatter."""

HARDENING_PART = EffectParameter(
    name="hardening_part",
    unit="",
    lower=-0.3,
    upper=0.5,
    centre=0.05,
    scale=0.05,
    reason="-d ln G / dT over the softening: polyethylene's G falls by 0.5 % per degree, an elastomer's rises by 0.3 %",
)


def warmed(rise: FloatArray, softening: float, hardening_part: float) -> Modification:
    """The law at a temperature above the usual one by `rise` (n,) [°C]: tau_max e^(-a T), G e^(-b a T)."""
    return Modification(
        relaxation_time_factor=np.exp(-softening * rise),
        hardening_factor=np.exp(-hardening_part * softening * rise),
    )
