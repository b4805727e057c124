"""Interpolation between the rates: no form is assumed, and nothing is smoothed."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import Companion, Table

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def _parameters(companion: Companion) -> FloatArray:
    return np.array(cast("Table", companion).tau_max)


def _log_gradient(companion: Companion, rates: FloatArray) -> FloatArray:
    """Hat functions in ln r over tau_max; beyond the ends the end segments go on."""
    table = cast("Table", companion)
    knots, at = np.log(table.rates), np.log(rates)
    left = np.clip(np.searchsorted(knots, at) - 1, 0, len(knots) - 2)
    part = (at - knots[left]) / (knots[left + 1] - knots[left])
    gradient = np.zeros((len(rates), len(knots)))
    rows = np.arange(len(rates))
    gradient[rows, left] = 1.0 - part
    gradient[rows, left + 1] = part
    return np.asarray(gradient / np.array(table.tau_max))


FORM = Form(
    name="table",
    title="interpolation, straight in log-log axes",
    parameter_names=(),
    measure="ln τ_max",
    relation=lambda values, rates, calibrated: Table(
        tuple(rates.tolist()), tuple(values.tolist()), calibrated=calibrated
    ),
    parameters=_parameters,
    start=lambda rates, tau_max: tau_max,
    log_gradient=_log_gradient,
    reference=True,
)
