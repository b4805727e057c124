"""The synthetic data of experiments 2 and 3, and the paper's three identifications on them."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.identify.fit import fit
from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED
from probation.law.settings import CompanionSettings, LawSettings
from probation.published.experiments import NeckingSet, Twin, experiment_1, experiment_2, experiment_3
from probation.published.numbers import TABLE_3, TABLE_4, UNRELAXED_MODULUS, GripTable
from probation.records.campaign import Campaign

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.identify.result import Fit

Grip = Literal[2, 3]
GRIPS: tuple[Grip, ...] = (2, 3)

PUBLISHED: dict[Grip, GripTable] = {2: TABLE_3, 3: TABLE_4}

_WEISSENBERG = CompanionSettings(
    "weissenberg", {"slope": WEISSENBERG_AS_PRINTED.slope, "intercept": WEISSENBERG_AS_PRINTED.intercept}
)
_EXPONENTIAL = CompanionSettings(
    "exponential",
    {"coefficient": EXPONENTIAL_AS_PRINTED.coefficient, "exponent": EXPONENTIAL_AS_PRINTED.exponent},
)
_KNOWN = {"unrelaxed_modulus_MPa": UNRELAXED_MODULUS}

OPTIONS: dict[int, LawSettings] = {
    2: LawSettings(companion=_WEISSENBERG, fixed=_KNOWN),
    3: LawSettings(companion=_EXPONENTIAL, fixed=_KNOWN),
    4: LawSettings(companion=_WEISSENBERG),
}
"""Identifications 2, 3 and 4 of Tables 3 and 4: α with (11), α with (12), α with (11) and E_u free."""


@lru_cache(maxsize=16)
def twin(number: Literal[1, 2, 3], seed: int, necking: NeckingSet = "P2") -> Twin:
    """The synthetic record of that experiment; experiments 2 and 3 with that set of (A-1)."""
    if number == 1:
        return experiment_1(seed)
    return experiment_2(seed, necking=necking) if number == 2 else experiment_3(seed, necking=necking)


@lru_cache(maxsize=32)
def identify(test: Twin, option: int) -> Fit:
    """One of `OPTIONS` identified on a synthetic record."""
    return fit(Campaign(name=test.name, records=(test.record(),), law=OPTIONS[option]), gap=False)


@lru_cache(maxsize=8)
def identified(number: Grip, seed: int) -> dict[int, Fit]:
    """Each of `OPTIONS` identified on the synthetic record of experiment 2 or 3."""
    return {option: identify(twin(number, seed), option) for option in OPTIONS}


def fit_residual(found: Fit) -> FloatArray:
    """Model minus data of a fit on one record, shape (n_times,) [MPa]."""
    (record,) = found.records.values()
    return record.fit_residual


def cost(found: Fit) -> float:
    """The paper's cost function: the sum of squared residuals [MPa^2]."""
    return float(np.sum(fit_residual(found) ** 2))


def end_rate_ratio(number: Grip, seed: int) -> float:
    """Largest over smallest strain rate of the test [-]."""
    rate = twin(number, seed).strain_rate
    return float(rate.max() / rate.min())
