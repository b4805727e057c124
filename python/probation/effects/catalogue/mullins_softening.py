"""The network is softer below the largest strain so far."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erf

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible import unloads
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_SOFTENING = EffectParameter(
    "softening", "", 0.0, 0.95, 0.3, "1/r; filled elastomers lose 10 to 60 % of the stress, unfilled ones some per cent"
)
_WIDTH = EffectParameter(
    name="softening_invariant",
    unit="",
    lower=0.003,
    upper=100.0,
    centre=0.5,
    scale=1.5,
    log=True,
    starts=(0.1, 1.0),
    reason="2 m / G of Ogden and Roxburgh: a good part of the energy that the test stored",
)


def _below(view: RecordView) -> FloatArray:
    """I_m - I: the first invariant below its largest so far, shape (n,); twice an energy over G in a neo-Hookean."""
    stored = np.where(view.true_strain > 0.0, view.first_invariant, 0.0)
    return np.asarray(np.maximum.accumulate(stored) - stored)


def _ogden_roxburgh(view: RecordView, values: Values) -> Modification:
    """Stress times 1 - a erf((I_m - I) / w), I the first invariant and I_m its largest so far."""
    return Modification(load_bearing_area=1.0 - values[0] * erf(_below(view) / values[1]))


def _dorfmann_ogden(view: RecordView, values: Values) -> Modification:
    """Stress times 1 - a tanh((I_m - I) / w), I the first invariant and I_m its largest so far."""
    return Modification(load_bearing_area=1.0 - values[0] * np.tanh(_below(view) / values[1]))


def _of_the_network(view: RecordView, values: Values) -> Modification:
    """G times 1 - a erf((I_m - I) / w): only the network softens, the spectrum does not."""
    return Modification(hardening_factor=1.0 - values[0] * erf(_below(view) / values[1]))


EFFECT = Effect(
    name="mullins_softening",
    title="Mullins softening",
    physics=(
        "Below the largest strain so far the material is softer, and whole again where it goes on beyond it.\n"
        "Amplitude: part of the stress that is lost far below the largest strain."
    ),
    source=(
        "Ogden & Roxburgh 1999, Proc. R. Soc. A 455, 2861; Dorfmann & Ogden 2003, Int. J. Solids Struct. 40, 2699; "
        "Qi & Boyce 2004, J. Mech. Phys. Solids 52, 2187"
    ),
    shows_in="unloading and reloading below the largest strain so far",
    kind="material",
    coordinate="strain_below_largest",
    forms=(
        Form("ogden_roxburgh", (_SOFTENING, _WIDTH), modification=_ogden_roxburgh, needs=unloads),
        Form("dorfmann_ogden", (_SOFTENING, _WIDTH), modification=_dorfmann_ogden, needs=unloads),
        Form("of_the_network", (_SOFTENING, _WIDTH), modification=_of_the_network, needs=unloads),
    ),
    odds=0.3,
)
