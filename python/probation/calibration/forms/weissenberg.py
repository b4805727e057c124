"""Eq. (11): the Weissenberg number is linear in log10 of the rate."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import Companion, Weissenberg

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def _start(rates: FloatArray, tau_max: FloatArray) -> FloatArray:
    """Linear regression of We = tau_max r on log10 r; their mean where the line would be negative at some rate."""
    line: FloatArray = np.polyfit(np.log10(rates), rates * tau_max, 1)
    if np.any(np.polyval(line, np.log10(rates)) <= 0.0):
        return np.array([0.0, np.mean(rates * tau_max)])
    return line


def _log_gradient(companion: Companion, rates: FloatArray) -> FloatArray:
    """Ln tau_max = ln(slope log10 r + intercept) - ln r."""
    return np.stack([np.log10(rates), np.ones_like(rates)], axis=1) / companion.weissenberg_number(rates)[:, None]


def _parameters(companion: Companion) -> FloatArray:
    relation = cast("Weissenberg", companion)
    return np.array([relation.slope, relation.intercept])


FORM = Form(
    name="weissenberg",
    title="Weissenberg number linear in log10 of the rate, eq. (11)",
    parameter_names=("slope", "intercept"),
    measure="We",
    relation=lambda values, rates, calibrated: Weissenberg(float(values[0]), float(values[1]), calibrated=calibrated),
    parameters=_parameters,
    start=_start,
    log_gradient=_log_gradient,
)
