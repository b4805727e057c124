"""Which form predicts a rate that it has not seen: each rate left out in turn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import fdtri

from probation.calibration.companion_forms import CHOOSABLE, FORMS
from probation.calibration.regression import regress
from probation.errors import InputError
from probation.settings.companion import COMPANION

SMALLEST_REPORTED = 1e-5
"""A smaller error in ln tau_max is reported as less than that."""

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.calibration.rate_table import RateTable
    from probation.calibration.regression import Regression


@dataclass(frozen=True, eq=False)
class Score:
    """How well one form predicts what was left out.

    Attributes
    ----------
    log_error : ndarray, shape (n,)
        Predicted minus identified ln tau_max, each row by the relation of the other rates; NaN where there is none.
    weights : ndarray, shape (n,)
        Of its square, alike for all forms.
    """

    form: str
    log_error: FloatArray
    weights: FloatArray

    @property
    def rms(self) -> float:
        """Weighted root mean square of the error in ln tau_max [-]; NaN where it cannot be had."""
        return float(np.sqrt(np.average(self.log_error**2, weights=self.weights)))

    @property
    def largest(self) -> float:
        """Largest error in ln tau_max [-]."""
        return float(np.max(np.abs(self.log_error)))


def leave_one_rate_out(table: RateTable, regressions: Mapping[str, Regression]) -> dict[str, Score]:
    """Predict each rate from the others, by every form that was regressed.

    Rows are weighted by their errors, where known: 1 / (standard error² + s²), s the scatter around the best of the
    forms, so that one row with a tiny error does not decide alone.
    """
    weights = np.ones(len(table))
    error = table.log_error
    if error is not None:
        least = min((regressions[name].log_scatter for name in CHOOSABLE if name in regressions), default=0.0)
        weights = 1.0 / (error**2 + least**2)
    scores = {}
    for name in regressions:
        predicted = np.full(len(table), np.nan)
        for group in table.groups:
            try:
                relation = regress(FORMS[name], table.without(group)).relation
                predicted[group] = np.log(relation.relaxation_time(table.rates[group]))
            except InputError:  # too few rates are left, or no positive time there
                continue
        scores[name] = Score(name, predicted - np.log(table.tau_max), weights)
    return scores


def best(scores: Mapping[str, Score]) -> str | None:
    """The form with the lowest score, the first of equals; None where no score could be had."""
    known = [name for name in CHOOSABLE if name in scores and np.isfinite(scores[name].rms)]
    if not known:
        return None
    lowest = min(scores[name].rms for name in known)
    return next(name for name in known if scores[name].rms <= lowest * (1.0 + 1e-6))


def apart(one: Score, other: Score) -> bool:
    """Whether the second's mean square is above the first's by more than chance: an F test.

    Crude, since the errors of two forms on the same rates are no independent draws; it asks for a factor of 2.2 in the
    rms with five rates, of 3 with three.
    """
    count = int(np.sum(np.isfinite(one.log_error)))
    if count == 0 or not np.isfinite(other.rms):
        return False
    return bool(other.rms**2 > float(fdtri(count, count, 1.0 - COMPANION.apart_level)) * one.rms**2)


def percent(error: float, sign: str = "") -> str:
    """An error in ln tau_max, in per cent; above 100 % it is no longer that of tau_max."""
    if not np.isfinite(error):
        return "–"
    if 0.0 < abs(error) < SMALLEST_REPORTED:
        return f"< {100.0 * SMALLEST_REPORTED:g}"
    digits = ".0f" if abs(error) >= 0.1 else ".1f" if abs(error) >= 0.0005 else ".1g"
    return f"{100.0 * error:{sign}{digits}}"
