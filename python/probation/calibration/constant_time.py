"""Whether one constant tau_max suits every rate, so that no companion relation is needed."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtrc

from probation.calibration.cross_validation import best
from probation.settings.companion import COMPANION

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation.calibration.cross_validation import Score
    from probation.calibration.rate_table import RateTable


def why_constant(table: RateTable | None, scores: Mapping[str, Score]) -> str | None:
    """Why one tau_max for all rates is enough, as a clause; None where it depends on the rate.

    It is enough where the tau_max of all rates agree to within their standard errors or to within
    `negligible_dependence`, or where no relation predicts left-out rates better.

    Parameters
    ----------
    table : RateTable or None
        None for the direct route.
    scores : dict of str to Score
        By form; may be empty.
    """
    if table is not None:
        error = table.log_error
        weights = np.ones(len(table)) if error is None else error**-2.0
        distance = np.log(table.tau_max) - np.average(np.log(table.tau_max), weights=weights)
        chance = 0.0 if error is None else float(chdtrc(len(table) - 1, np.sum((distance / error) ** 2)))
        if chance > COMPANION.constant_level:
            return f"that of all rates agrees to within its errors (p = {chance:.2g})"
        if np.max(np.abs(distance)) < COMPANION.negligible_dependence:
            return f"that of all rates agrees to {100.0 * float(np.max(np.abs(distance))):.1g} %"
    lowest = best(scores)
    if lowest is not None and "constant" in scores and scores["constant"].rms <= scores[lowest].rms:
        return "no relation predicts rates left out better"
    return None
