"""One Weissenberg number at every rate: tau_max is inverse to the rate, and only the clock changes."""

from __future__ import annotations

from typing import cast

import numpy as np

from probation.calibration.forms.form import Form
from probation.law.companion import PowerLaw

FORM = Form(
    name="constant-weissenberg",
    title="one Weissenberg number at every rate",
    parameter_names=("weissenberg_number",),
    measure="ln τ_max",
    relation=lambda values, rates, calibrated: PowerLaw(float(values[0]), -1.0, calibrated=calibrated),
    parameters=lambda companion: np.array([cast("PowerLaw", companion).coefficient]),
    start=lambda rates, tau_max: np.array([np.exp(np.mean(np.log(rates * tau_max)))]),
    log_gradient=lambda companion, rates: np.full((len(rates), 1), 1.0 / cast("PowerLaw", companion).coefficient),
    reference=True,
)
