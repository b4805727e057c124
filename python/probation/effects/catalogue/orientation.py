"""Chains that turn into the direction of pulling."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_TIMES = EffectParameter(
    "log_time_gain", "", 0.0, 5.0, 0.5, "oriented polymers flow and creep several times more slowly"
)
_MODULUS = EffectParameter(
    "log_modulus_gain", "", 0.0, 3.0, 0.3, "polyethylene drawn tenfold, a true strain of 2.3, is several times as stiff"
)


def _strain(view: RecordView) -> FloatArray:
    """True strain in tension."""
    return np.maximum(view.true_strain, 0.0)


def _order(view: RecordView) -> FloatArray:
    """Ward's <P_2> of units that turn like lines of the specimen (Kratky 1933), over its slope in the true strain, 3/5.

    <cos^2> = x (1 - atan(y) / y) / y^2 with x = stretch^3, y^2 = x - 1, and <P_2> = (3 <cos^2> - 1) / 2.
    """
    beyond = np.maximum(np.expm1(3.0 * view.true_strain), 1e-6)
    root = np.sqrt(beyond)
    cosine = (1.0 + beyond) / beyond * (1.0 - np.arctan(root) / root)
    return np.asarray((3.0 * cosine - 1.0) / 2.0 / 0.6)


def _times(view: RecordView, values: Values) -> Modification:
    """tau_max exp(a e), e the true strain."""
    return Modification(relaxation_time_factor=np.exp(values[0] * _strain(view)))


def _modulus(view: RecordView, values: Values) -> Modification:
    """E_u exp(a e), e the true strain."""
    return Modification(unrelaxed_modulus_factor=np.exp(values[0] * _strain(view)))


def _times_of_units(view: RecordView, values: Values) -> Modification:
    """tau_max exp(a p), p the order of units that turn like lines: it levels off at 5/3."""
    return Modification(relaxation_time_factor=np.exp(values[0] * _order(view)))


def _modulus_of_units(view: RecordView, values: Values) -> Modification:
    """E_u exp(a p), p the order of units that turn like lines: it levels off at 5/3."""
    return Modification(unrelaxed_modulus_factor=np.exp(values[0] * _order(view)))


EFFECT = Effect(
    name="orientation",
    title="orientation of the chains",
    physics=(
        "Chains turn into the direction of pulling: the material flows more slowly along them, or is stiffer.\n"
        "Amplitude: gain of ln tau_max (or of ln E_u) per true strain, at first."
    ),
    source=(
        "Senden, van Dommelen & Govaert 2010, J. Polym. Sci. B 48, 1483 (times); Ward 1962, Proc. Phys. Soc. 80, 1176 "
        "(modulus); Kratky 1933, Kolloid-Z. 64, 213 (units that turn like lines)"
    ),
    shows_in="large strains: rate jumps, dwells and unloading there, against those at small strains",
    kind="material",
    odds=0.3,
    forms=(
        Form("relaxation_time", (_TIMES,), modification=_times),
        Form("modulus", (_MODULUS,), modification=_modulus),
        Form("relaxation_time_of_units", (_TIMES,), modification=_times_of_units, variant=True),
        Form("modulus_of_units", (_MODULUS,), modification=_modulus_of_units, variant=True),
    ),
)
