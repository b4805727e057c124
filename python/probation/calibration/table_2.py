"""Table 2 of the paper: tau_max of HDPE at five constant strain rates."""

from __future__ import annotations

import numpy as np

from probation.calibration.rate_table import RateTable

TABLE_2 = RateTable(
    rates=np.array([5e-5, 4e-4, 2.5e-3, 5e-3, 1e-2]),
    tau_max=np.array([419.72, 63.23, 11.02, 6.01, 3.21]),
    hardening_modulus=np.array([1.53, 1.85, 2.31, 2.31, 2.46]),
    labels=tuple(f"row {number}" for number in range(1, 6)),
    source="Table 2 (André et al.)",
)
"""Average over specimens; no standard errors were published. Figure S2 draws "a fictitious 10 % uncertainty"."""

PRINTED_WEISSENBERG = (0.0209, 0.0253, 0.0276, 0.0301, 0.0321)
"""We as printed in Table 2 [-]: tau_max times the rate, rounded."""

FICTITIOUS_ERROR = 0.10
"""Relative error bars of Figure S2."""
