"""No relation: one tau_max at every rate."""

from __future__ import annotations

from typing import cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import PowerLaw

FORM = Form(
    name="constant",
    title="one τ_max at every rate: no relation",
    parameter_names=("tau_max_s",),
    measure="ln τ_max",
    relation=lambda values, rates, calibrated: PowerLaw(float(values[0]), 0.0, calibrated=calibrated),
    parameters=lambda companion: np.array([cast("PowerLaw", companion).coefficient]),
    start=lambda rates, tau_max: np.array([np.exp(np.mean(np.log(tau_max)))]),
    log_gradient=lambda companion, rates: np.full((len(rates), 1), 1.0 / cast("PowerLaw", companion).coefficient),
    reference=True,
)
