"""tau_max follows the strain rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.rate_onset import ONSET_RATE
from probation.law.modification import Modification, RateShift

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

_EXPONENT = EffectParameter(
    name="rate_exponent",
    unit="",
    lower=-0.5,
    upper=1.5,
    scale=0.5,
    reason="0 is a constant time, 1 a constant Weissenberg number; HDPE has 0.92 without a companion relation",
)
_CURVATURE = EffectParameter(
    name="weissenberg_change_per_decade",
    unit="",
    lower=-0.3,
    upper=0.5,
    centre=0.18,
    scale=0.15,
    reason="0.00464 / 0.026 of eq. (11) at its calibrated rates",
)


def _power(view: RecordView, values: Values) -> Modification:
    """tau_max (r / r_ref)^(-a); where there is a companion relation, a changes its slope."""
    return Modification(rate_shift=RateShift(values[0], 0.0, view.reference_rate))


def _weissenberg(view: RecordView, values: Values) -> Modification:
    """The Weissenberg number is linear in log10 of the rate, eq. (11), where a = 1 - s / ln 10."""
    return Modification(rate_shift=RateShift(values[0], values[1], view.reference_rate))


def _from_a_rate(view: RecordView, values: Values) -> Modification:
    """tau_max (1 + (1 / b)^a) / (1 + (r / (b r_ref))^a): nothing changes far below the rate b r_ref (Cross)."""
    exponent, onset = values[0], np.log(values[1])
    above = np.logaddexp(0.0, exponent * (view.log_rate - onset)) - np.logaddexp(0.0, -exponent * onset)
    return Modification(relaxation_time_factor=np.exp(-above))


EFFECT = Effect(
    name="rate_dependent_relaxation",
    title="rate-dependent relaxation",
    physics=(
        "All relaxation times shift with the strain rate: faster straining shortens them.\n"
        "Amplitude: -d ln tau_max / d ln rate at the reference rate, on top of the law's own companion relation."
    ),
    source="André et al., eqs. (10)-(12); Cross 1965, J. Colloid Sci. 20, 417 (from a rate on)",
    shows_in="records at different rates, or one whose rate changes (necking, jumps)",
    kind="material",
    coordinate="strain_rate",
    forms=(
        Form("power", (_EXPONENT,), modification=_power),
        Form("weissenberg", (_EXPONENT, _CURVATURE), modification=_weissenberg),
        Form("from_a_rate", (_EXPONENT, ONSET_RATE), modification=_from_a_rate, variant=True),
    ),
)
