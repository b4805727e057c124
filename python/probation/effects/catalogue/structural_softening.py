"""An aged start that straining rejuvenates."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_TIMES = EffectParameter(
    "log_time_excess", "", 0.0, 4.0, 0.5, "a yield drop of 10 to 50 % of a rejuvenated polymer's stress"
)
_STRAIN = EffectParameter(
    name="softening_strain",
    unit="",
    lower=0.005,
    upper=1.0,
    centre=0.08,
    scale=0.8,
    log=True,
    starts=(0.03, 0.15),
    reason="aged glassy and semi-crystalline polymers soften within 5 to 20 % of strain",
)
_SHARPNESS = 30.0
"""Klompen and others' r_1 [1/true strain] (2005): the plateau ends within some 2 / r_1 = 0.07 of strain."""


def _excess(view: RecordView, values: Values) -> FloatArray:
    return np.exp(values[0] * np.exp(-view.largest_strain / values[1]))


def _plateau(view: RecordView, values: Values) -> Modification:
    """tau_max exp(a S), S = ((1 + e^(r (e - e_0))) / (1 + e^(-r e_0)))^(-1 / (r e_s)), e the largest strain so far.

    That is Klompen and others' S with r_0 = e^(-e_0), r_1 = r and (r_2 - 1) = -1 / e_s: about 1 up to the strain e_0,
    then falling by a factor e within e_s.
    """
    rise = np.logaddexp(0.0, _SHARPNESS * (view.largest_strain - values[2]))
    at_rest = np.logaddexp(0.0, -_SHARPNESS * values[2])
    left = np.exp(-(rise - at_rest) / (_SHARPNESS * values[1]))
    return Modification(relaxation_time_factor=np.exp(values[0] * left))


def _times(view: RecordView, values: Values) -> Modification:
    """tau_max exp(a e^(-e / e_s)), e the largest strain so far."""
    return Modification(relaxation_time_factor=_excess(view, values))


def _modulus(view: RecordView, values: Values) -> Modification:
    """E_u exp(a e^(-e / e_s)), e the largest strain so far."""
    return Modification(unrelaxed_modulus_factor=_excess(view, values))


EFFECT = Effect(
    name="structural_softening",
    title="structural softening",
    physics=(
        "A specimen that has aged starts out stiffer or slower; straining rejuvenates it, once and for all.\n"
        "Amplitude: ln of the excess of tau_max (or E_u) at the start over what it becomes."
    ),
    source="Klompen, Engels, Govaert & Meijer 2005, Macromolecules 38, 6997; Hasan & Boyce 1993, Polymer 34, 5085",
    shows_in="the first tenths of strain of every record, and no second loading",
    kind="material",
    coordinate="largest_strain",
    forms=(
        Form(
            "relaxation_time",
            (
                _TIMES,
                _STRAIN,
            ),
            modification=_times,
        ),
        Form(
            "modulus",
            (
                EffectParameter(
                    "log_modulus_excess", "", 0.0, 2.0, 0.3, "ageing stiffens by some tenths, seldom by twice"
                ),
                _STRAIN,
            ),
            modification=_modulus,
        ),
        Form(
            "plateau",
            (
                _TIMES,
                _STRAIN,
                EffectParameter(
                    name="plateau_strain",
                    unit="",
                    lower=0.0,
                    upper=1.0,
                    centre=0.05,
                    scale=0.1,
                    reason="softening begins at yield",
                ),
            ),
            modification=_plateau,
            variant=True,
        ),
    ),
)
