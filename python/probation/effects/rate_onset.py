"""A dependence on the strain rate that sets in from a rate on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import EffectParameter

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

ONSET_RATE = EffectParameter(
    name="onset_over_reference_rate",
    unit="",
    lower=1e-3,
    upper=1e4,
    centre=1.0,
    scale=2.0,
    log=True,
    starts=(0.1, 10.0),
    reason="anywhere among the rates of the tests",
)


def log_rate_from(view: RecordView, onset: float) -> FloatArray:
    """ln((1 + r / (b r_ref)) / (1 + 1 / b)), shape (n,): as the rate far above b r_ref, one value far below it.

    For a small a, e^(a times it) is 1 + a ln(1 + r / (b r_ref)) but for a constant factor (Johnson & Cook 1983).
    """
    return np.asarray(np.log((onset + np.exp(view.log_rate)) / (onset + 1.0)))
