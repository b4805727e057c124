"""A back stress grows with the strain and turns with it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.backlash import behind
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.maxwell_element import maxwell_element
from probation.effects.visible import unloads
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_SIZE = EffectParameter(
    name="back_stress_MPa",
    unit="MPa",
    lower=0.0,
    upper=500.0,
    scale=3.0,
    reason="C/gamma; a tenth of a polymer's yield stress, some tenths of a metal's",
)
_REACH = EffectParameter(
    name="reach_strain",
    unit="",
    lower=1e-3,
    upper=2.0,
    centre=0.05,
    scale=1.0,
    log=True,
    starts=(0.02, 0.1),
    reason="1/gamma; one to ten per cent of strain from a reversal on",
)


_YIELD = EffectParameter(
    name="yield_strain",
    unit="",
    lower=1e-4,
    upper=0.2,
    centre=0.02,
    scale=1.0,
    log=True,
    starts=(0.02,),
    reason="half of the elastic range: yield stress over modulus, some hundredths for polymers, thousandths for metals",
)
_SPREAD = EffectParameter(
    name="spread_decades",
    unit="",
    lower=0.0,
    upper=1.5,
    centre=0.4,
    scale=0.4,
    starts=(0.4,),
    reason="two or three surfaces, each some times as far as the one before",
)
_TIME_LOSS = EffectParameter(
    name="log_time_loss",
    unit="",
    lower=0.0,
    upper=5.0,
    scale=0.7,
    reason="a yield stress that is lower by some tenths when the straining turns",
)


def _saturating(strain: FloatArray, reach: float) -> FloatArray:
    """X / a, dX = (a / r) de - (X / r) |de|, along a strain (n,)."""
    # Along the length of the path a Maxwell element; the path must grow, if only by a trifle.
    path = np.append(0.0, np.cumsum(np.abs(np.diff(strain)) + 1e-12 * reach))
    return np.asarray(maxwell_element(path, strain, reach) / reach)


def _armstrong_frederick(view: RecordView, values: Values) -> Modification:
    """Back stress X, dX = (a / r) de - (X / r) |de|, added to the relaxed stress."""
    size, reach = values
    return Modification(added_relaxed_stress=size * _saturating(view.strain_behind_backlash, reach))


def _several_surfaces(view: RecordView, values: Values) -> Modification:
    """Three such stresses of a third each, along the plastic strain: that behind an elastic range (Prandtl's slider).

    Their reaches are r, and r times and over 10^spread (Chaboche 1986).
    """
    size, reach, elastic, spread = values
    plastic = behind(view.true_strain, elastic)
    surfaces = [_saturating(plastic, reach * factor) for factor in (10.0**-spread, 1.0, 10.0**spread)]
    return Modification(added_relaxed_stress=size * np.mean(surfaces, axis=0))


def _slip_element(view: RecordView, values: Values) -> Modification:
    """Back stress of a spring and a slider, dX = (a / r) de while |X| < a, added to the relaxed stress."""
    size, reach = values
    strain = view.strain_behind_backlash
    return Modification(added_relaxed_stress=size / reach * (strain - behind(strain, reach)))


def _after_reversal(view: RecordView, values: Values) -> Modification:
    """tau_max exp(-a e^(-p / r)), p the path since the last reversal: flow is easier until the way back is made."""
    loss, reach = values
    return Modification(relaxation_time_factor=np.exp(-loss * np.exp(-view.path_since_reversal / reach)))


EFFECT = Effect(
    name="back_stress",
    title="back stress",
    physics=(
        "Straining leaves internal stresses that help the way back: flow begins early after a reversal (Bauschinger).\n"
        "Amplitude: the stress at which it saturates, which no rate changes and no dwell relaxes; or ln of tau_max "
        "over what it is when the straining turns."
    ),
    source=(
        "Prager 1956, J. Appl. Mech. 23, 493; Armstrong & Frederick 1966, CEGB report RD/B/N731; Iwan 1966, J. Appl. "
        "Mech. 33, 893; Chaboche 1986, Int. J. Plasticity 2, 149; Yoshida & Uemori 2002, Int. J. Plasticity 18, 661"
    ),
    shows_in="reversals, where the strain is taken back by some hundredths",
    kind="material",
    forms=(
        Form("armstrong_frederick", (_SIZE, _REACH), modification=_armstrong_frederick, needs=unloads),
        Form(
            "several_surfaces",
            (_SIZE, _REACH, _YIELD, _SPREAD),
            modification=_several_surfaces,
            needs=unloads,
            variant=True,
        ),
        Form("slip_element", (_SIZE, _REACH), modification=_slip_element, needs=unloads),
        Form("after_reversal", (_TIME_LOSS, _REACH), modification=_after_reversal, needs=unloads),
    ),
    odds=0.3,
)
