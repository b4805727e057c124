"""Eq. (12): tau_max is exponential in log10 of the rate.

c exp(e log10(1000 r)) = c 1000^(e / ln 10) r^(e / ln 10): the same function as a power law. What sets (12) apart is how
the paper fitted it, by least squares of tau_max itself, which the slowest rates decide.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import Companion, Exponential

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def _start(rates: FloatArray, tau_max: FloatArray) -> FloatArray:
    exponent, constant = np.polyfit(np.log10(1000.0 * rates), np.log(tau_max), 1)
    return np.array([np.exp(constant), exponent])


def _parameters(companion: Companion) -> FloatArray:
    relation = cast("Exponential", companion)
    return np.array([relation.coefficient, relation.exponent])


def _log_gradient(companion: Companion, rates: FloatArray) -> FloatArray:
    coefficient = cast("Exponential", companion).coefficient
    return np.stack([np.full_like(rates, 1.0 / coefficient), np.log10(1000.0 * rates)], axis=1)


FORM = Form(
    name="exponential",
    title="exponential of log10 of the rate, eq. (12), regressed in τ_max",
    parameter_names=("coefficient", "exponent"),
    measure="τ_max",
    relation=lambda values, rates, calibrated: Exponential(float(values[0]), float(values[1]), calibrated=calibrated),
    parameters=_parameters,
    start=_start,
    log_gradient=_log_gradient,
    same_as="power",
)
