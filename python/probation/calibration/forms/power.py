"""Power law: ln tau_max is linear in ln of the rate."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import Companion, PowerLaw

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def _start(rates: FloatArray, tau_max: FloatArray) -> FloatArray:
    exponent, constant = np.polyfit(np.log(rates), np.log(tau_max), 1)
    return np.array([np.exp(constant), exponent])


def _parameters(companion: Companion) -> FloatArray:
    relation = cast("PowerLaw", companion)
    return np.array([relation.coefficient, relation.exponent])


def _log_gradient(companion: Companion, rates: FloatArray) -> FloatArray:
    coefficient = cast("PowerLaw", companion).coefficient
    return np.stack([np.full_like(rates, 1.0 / coefficient), np.log(rates)], axis=1)


FORM = Form(
    name="power",
    title="power of the rate, regressed in ln τ_max",
    parameter_names=("coefficient", "exponent"),
    measure="ln τ_max",
    relation=lambda values, rates, calibrated: PowerLaw(float(values[0]), float(values[1]), calibrated=calibrated),
    parameters=_parameters,
    start=_start,
    log_gradient=_log_gradient,
)
