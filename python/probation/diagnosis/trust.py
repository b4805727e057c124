"""How far the evidence of explanations counts: where forms are nearly the catalogue's, and where they are others."""

from __future__ import annotations

from dataclasses import dataclass
from math import comb, log
from typing import TYPE_CHECKING, Protocol

import numpy as np
from scipy.special import logsumexp

from probation.inference.unknown import UNKNOWN
from probation.settings.calibrated import CALIBRATED
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.inference.calibration_check import CalibrationCheck

Effects = tuple[str, ...]
ALONE = (UNKNOWN,)


class Trust(Protocol):
    """What evidence makes of explanations."""

    def log_weights(
        self, log_evidence: Mapping[Effects, float], log_odds: Mapping[Effects, float], count: int
    ) -> FloatArray:
        """Of every explanation, in the order of `log_evidence`; probabilities are their exponentials over their sum.

        Parameters
        ----------
        log_evidence : mapping
            Of every explanation, () among them, but for a constant.
        log_odds : mapping
            Of its effects relative to usual ones, beforehand.
        count : int
            Of the catalogue.
        """

    def fall(self, distance: FloatArray) -> FloatArray:
        """Log odds of a known effect that is so far in log evidence behind the best one."""


@dataclass(frozen=True)
class Tempered:
    """Evidence to a power, times what was probable beforehand: forms are nearly the catalogue's.

    Attributes
    ----------
    power : float
        Below 1 evidence is trusted less than it trusts itself.
    """

    power: float = 1.0

    def log_weights(
        self, log_evidence: Mapping[Effects, float], log_odds: Mapping[Effects, float], count: int
    ) -> FloatArray:
        """As in `Trust`."""
        return np.array(
            [self.power * own + log_prior(names, count) + log_odds[names] for names, own in log_evidence.items()]
        )

    def fall(self, distance: FloatArray) -> FloatArray:
        """As in `Trust`."""
        return -self.power * distance


@dataclass(frozen=True)
class OtherForms:
    """Forms are others than the catalogue's: a right explanation may be hundreds of log units behind a wrong one.

    So odds fall with a power of the distance D in log evidence from the best explanation, o (1 + D)^-a. An unknown
    effect has no form that could be wrong: with it they fall as o exp(-b D). The odds o are those over a single known
    effect as near to the best one; what is rare elsewhere may not be so in a laboratory that nobody knows. Known
    effects with no more evidence than none explain nothing: they have no probability.

    Attributes
    ----------
    fall_with_distance : float
        The power a.
    unknown_power : float
        The power b to which evidence counts where an unknown effect acts.
    two, three : float
        Odds of two and of three known effects, or more.
    unknown, unknown_with_known : float
        Odds of an effect outside the catalogue alone and jointly with known ones.
    most_unknown : float
        Most that an effect outside the catalogue keeps alone where known effects have plainly more evidence: it stands
        for all smooth functions, and is near to the best explanation of any large gap. "None" is left aside: where a
        gap is declared, the test leaves it next to nothing.
    """

    fall_with_distance: float
    unknown_power: float
    two: float
    three: float
    unknown: float
    unknown_with_known: float
    most_unknown: float = 1.0

    def log_weights(
        self, log_evidence: Mapping[Effects, float], log_odds: Mapping[Effects, float], count: int
    ) -> FloatArray:
        """As in `Trust`; `log_odds` and `count` have no say."""
        best, none = max(log_evidence.values()), log_evidence.get((), -np.inf)
        weights = {
            names: -np.inf if own <= none and names and UNKNOWN not in names else self._log_weight(names, best - own)
            for names, own in log_evidence.items()
        }
        known = max((own for names, own in log_evidence.items() if names and UNKNOWN not in names), default=-np.inf)
        if self.most_unknown < 1.0 and known - log_evidence.get(ALONE, np.inf) >= CALIBRATED.plain_lead:
            others = logsumexp([own for names, own in weights.items() if names and names != ALONE])
            most = max(self.most_unknown, EVIDENCE.least_p_value)
            weights[ALONE] = min(weights[ALONE], others + log(most / (1.0 - most)))
        return np.array(list(weights.values()))

    def fall(self, distance: FloatArray) -> FloatArray:
        """As in `Trust`."""
        return np.asarray(-self.fall_with_distance * np.log1p(distance))

    def _log_weight(self, names: Effects, distance: float) -> float:
        """Of an explanation; "none" has the odds of a single effect."""
        if UNKNOWN in names:
            odds = self.unknown if len(names) == 1 else self.unknown_with_known
            return log(odds) - self.unknown_power * distance
        odds = (1.0, 1.0, self.two, self.three)[min(len(names), 3)]
        return log(odds) + float(self.fall(np.asarray(distance)))


def trust_in(calibration: CalibrationCheck, followed: int = 1, visible: int = 1) -> Trust:
    """How far evidence counts in a campaign: less where nobody has seen how far it is to be trusted.

    Effects that the records could show, but the law cannot follow, count as unknown ones: each has the odds of a single
    effect, and the part that they are is not bounded by what an unknown may keep.

    Parameters
    ----------
    calibration : CalibrationCheck
    followed, visible : int
        Effects that the law can follow, of those that the records could show.
    """
    if calibration.inside:
        return Tempered(EVIDENCE.evidence_power)
    beyond = visible - followed
    return OtherForms(
        fall_with_distance=CALIBRATED.fall_with_distance,
        unknown_power=CALIBRATED.unknown_power_outside,
        two=CALIBRATED.odds_of_two,
        three=CALIBRATED.odds_of_three,
        unknown=CALIBRATED.odds_of_unknown + beyond,
        unknown_with_known=CALIBRATED.odds_of_unknown_with_known,
        most_unknown=1.0 - (1.0 - CALIBRATED.most_unknown_outside) * followed / max(visible, 1),
    )


def log_prior(effects: Effects, count: int) -> float:
    """Log prior probability of a set of effects of a catalogue of so many."""
    known = [name for name in effects if name != UNKNOWN]
    if len(known) < len(effects):
        return log(EVIDENCE.unknown_effect) if not known else log(EVIDENCE.unknown_with_known / count) * len(known)
    share = (EVIDENCE.no_effect, EVIDENCE.one_effect, EVIDENCE.two_effects, EVIDENCE.three_effects)[len(known)]
    return log(share / max(comb(count, len(known)), 1))
