"""The paper's (11) and (12) and its own Table 2, and the intercept of its Tables 3 and 4."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.calibration.companion_forms import FORMS
from probation.calibration.direct import DirectRoute
from probation.calibration.left_out import record_alpha
from probation.calibration.rate_table import RateTable
from probation.calibration.regression import Regression, regress
from probation.law.companion import EXPONENTIAL_AS_PRINTED, WEISSENBERG_AS_PRINTED, Companion
from probation.law.settings import LawSettings
from probation.published.experiments import experiment
from probation.published.numbers import STRAIN_RATE, TABLE_1, TABLE_2, UNRELAXED_MODULUS
from probation_studies.paper.grip_tests import PUBLISHED

if TYPE_CHECKING:
    from probation._arrays import FloatArray

RATE_TABLE = RateTable(
    rates=np.array([row.strain_rate for row in TABLE_2]),
    tau_max=np.array([row.tau_max for row in TABLE_2]),
    hardening_modulus=np.array([row.hardening_modulus for row in TABLE_2]),
    source="Table 2 (André et al.)",
)
"""Table 2: averages over specimens, published without standard errors."""


@dataclass(frozen=True)
class AlphaRatio:
    """alpha with (11) over alpha with (12) on one experiment.

    Attributes
    ----------
    printed : float
        From Tables 3 and 4 [-].
    as_printed, as_regressed : float
        On the synthetic record, with the intercept 0.0367 and with that of Table 2 [-].
    """

    experiment: int
    printed: float
    as_printed: float
    as_regressed: float


@dataclass(frozen=True, eq=False)
class PaperRelations:
    """What Table 2 says of (11) and (12).

    Attributes
    ----------
    weissenberg, exponential : Regression
        (11) regressed in We and (12) regressed in tau_max: what the paper says it did.
    rounded : tuple of float
        Slope and intercept from the rounded We of Table 2 instead of tau_max times the rate.
    percent : mapping of name to ndarray, shape (5,) [%]
        Errors of the relations on Table 2.
    anchored_intercept : float
        Of a line with the printed slope through experiment 1.
    ratios : tuple of AlphaRatio
    """

    weissenberg: Regression
    exponential: Regression
    rounded: tuple[float, float]
    percent: dict[str, FloatArray]
    anchored_intercept: float
    ratios: tuple[AlphaRatio, ...]

    def to_dict(self) -> dict[str, object]:
        """Numbers and findings."""
        return {
            "percent": self.percent,
            "anchored_intercept": self.anchored_intercept,
            "alpha_ratios": [vars(ratio) for ratio in self.ratios],
            "findings": self.sentences(),
        }

    def sentences(self) -> tuple[str, ...]:
        """The findings, for people."""
        slope, intercept = self.weissenberg.parameters
        rate, tau_max = STRAIN_RATE, TABLE_1[2].time.value
        own = float(WEISSENBERG_AS_PRINTED.relaxation_time([rate])[0])
        printed, eq_12 = self.percent["(11) as printed"], self.percent["(12) as printed"]
        ratios = " and ".join(f"{ratio.printed:.3f}" for ratio in self.ratios)
        by_printed = " and ".join(f"{ratio.as_printed:.3f}" for ratio in self.ratios)
        by_regressed = " and ".join(f"{ratio.as_regressed:.3f}" for ratio in self.ratios)
        return (
            f"Eq. (11) as printed does not fit the paper's own Table 2: it is {-printed.max():.0f} to "
            f"{-printed.min():.0f} % too short at every rate. Regressing τ_max·ε̇ of Table 2 gives the printed slope "
            f"and R² ({slope:.4f}, {self.weissenberg.r_squared:.3f}), but the intercept {intercept:.4f}, not 0.0367; "
            f"the rounded We of the table give {self.rounded[0]:.5f} and {self.rounded[1]:.4f}.",
            "0.0367 is nevertheless what Tables 3 and 4 were computed with: their α with (11) over their α with (12) "
            f"is {ratios}; on the synthetic data of experiments 2 and 3 it is {by_printed} with 0.0367, and "
            f"{by_regressed} with the regression.",
            f"A line of the printed slope through experiment 1 (τ_max = {tau_max:g} s at {rate:g} 1/s) has the "
            f"intercept {self.anchored_intercept:.4f}, and (11) as printed gives {own:.3f} s there: the slope is "
            "probably that of the regression, anchored on experiment 1.",
            f"Eq. (12) has R² = {_printed_r_squared():.5f} in τ_max because the slowest rates decide it: at the three "
            f"fastest it errs by {', '.join(f'{error:+.1f}' for error in eq_12[-3:])} %. The same function fitted in "
            f"ln τ_max, a power law, errs by {np.abs(self.percent['power law']).max():.1f} % at most.",
            "G of Table 2 grows from 1.53 to 2.46 MPa with the rate, and no companion relation takes that up.",
        )


@cache
def paper_relations() -> PaperRelations:
    """Compute the findings: three regressions of Table 2, six identifications of alpha on the synthetic data."""
    weissenberg, exponential = (regress(FORMS[name], RATE_TABLE) for name in ("weissenberg", "exponential"))
    power = regress(FORMS["power"], RATE_TABLE)
    rounded = np.polyfit(np.log10(RATE_TABLE.rates), [row.weissenberg for row in TABLE_2], 1)
    relations = {
        "(11) as printed": WEISSENBERG_AS_PRINTED,
        "(11) regressed": weissenberg.relation,
        "(12) as printed": EXPONENTIAL_AS_PRINTED,
        "(12) regressed": exponential.relation,
        "power law": power.relation,
    }
    rate, tau_max = STRAIN_RATE, TABLE_1[2].time.value
    return PaperRelations(
        weissenberg,
        exponential,
        (float(rounded[0]), float(rounded[1])),
        {name: _percent(relation) for name, relation in relations.items()},
        rate * tau_max - WEISSENBERG_AS_PRINTED.slope * float(np.log10(rate)),
        (_ratio(2, weissenberg.relation), _ratio(3, weissenberg.relation)),
    )


def _percent(relation: Companion) -> FloatArray:
    return np.asarray(100.0 * (relation.relaxation_time(RATE_TABLE.rates) / RATE_TABLE.tau_max - 1.0))


def _printed_r_squared() -> float:
    left = RATE_TABLE.tau_max - EXPONENTIAL_AS_PRINTED.relaxation_time(RATE_TABLE.rates)
    return 1.0 - float(left @ left) / float(np.sum((RATE_TABLE.tau_max - RATE_TABLE.tau_max.mean()) ** 2))


def _ratio(number: Literal[2, 3], regressed: Companion) -> AlphaRatio:
    """Identify alpha on one synthetic record with each relation, E_u held as in the paper."""
    with_11, with_12 = (PUBLISHED[number].identifications[row].time.value for row in (2, 3))
    printed, own, other = (
        _alpha(number, relation) for relation in (WEISSENBERG_AS_PRINTED, regressed, EXPONENTIAL_AS_PRINTED)
    )
    return AlphaRatio(number, with_11 / with_12, printed / other, own / other)


def _alpha(number: Literal[2, 3], relation: Companion) -> float:
    direct = DirectRoute.of([experiment(number).record()], LawSettings(), "sa3", "by-record")
    return float(np.exp(record_alpha(direct, 0, relation, UNRELAXED_MODULUS).log_alpha))
