"""Answers weighed anew by the log evidence that they state, as if evidence were trusted otherwise.

What is known only while records are at hand is left out: none is refused by a record that was held out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import log
from typing import TYPE_CHECKING, Any

from bench.answered import answered
from probation.diagnosis.probabilities import (
    Weighed,
    chances_of,
    effect_count,
    given_a_gap,
    with_unseen,
)
from probation.effects.registry import effects
from probation.errors import InputError
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.case import Case

if TYPE_CHECKING:
    from collections.abc import Mapping
    from pathlib import Path

    from probation.diagnosis.trust import Trust
    from probation.effects.effect import Effect
    from probation_studies.blind.scores.answer import Names

KNOWN = {effect.name: effect for effect in effects()}


@dataclass(frozen=True, eq=False)
class Gap:
    """A declared gap with a cause.

    Attributes
    ----------
    laboratory : str
    case : Case
    p_value : float
        Of the test for a gap.
    inside : bool
        Whether it lies within the calibrated ranges.
    log_evidence : dict
        Of every explanation that was fitted, over that of none.
    """

    laboratory: str
    case: Case
    p_value: float
    inside: bool
    log_evidence: dict[Names, float]

    @cached_property
    def considered(self) -> list[Effect]:
        """Effects that could act: those in some explanation, fitted or not."""
        return [
            KNOWN[name]
            for name in sorted({name for names in self.case.answer.probability for name in names})
            if name in KNOWN
        ]

    @cached_property
    def count(self) -> int:
        """How many share their prior probability."""
        return effect_count(self.considered)

    @cached_property
    def log_odds(self) -> dict[Names, float]:
        """Of effects that are rare."""
        return {names: sum(log(KNOWN[name].odds) for name in names if name in KNOWN) for names in self.log_evidence}

    def weighed(self, trust: Trust) -> list[Weighed]:
        """Explanations that were fitted, the most probable first: the answer set is taken from them."""
        chances = chances_of(self.log_evidence, self.log_odds, self.count, trust)
        found = [Weighed(names, chance, None) for names, chance in chances.items()]
        return given_a_gap(sorted(found, key=lambda each: -each.probability), self.p_value)

    def stated(self, found: list[Weighed]) -> dict[Names, float]:
        """Probabilities as an answer states them: with pairs whose second effect was not tried."""
        return {each.effects: each.probability for each in with_unseen(found, self.considered)}


def gaps_of(folder: Path) -> list[Gap]:
    """Declared gaps with a cause."""
    layout = Layout(folder)
    laboratory = str(layout.published()[0]["laboratory"])
    return [gap_in(laboratory, case, diagnosis) for case, diagnosis in answered(layout) if declared(case, diagnosis)]


def declared(case: Case, diagnosis: Mapping[str, Any] | None) -> bool:
    """Whether there is an answer that declares a gap, and the gap has a cause."""
    return diagnosis is not None and bool(case.causes) and case.answer.gap


def gap_in(laboratory: str, case: Case, diagnosis: Mapping[str, Any]) -> Gap:
    """A gap, from its answer.

    Raises
    ------
    InputError
        If the answer states no log evidence.
    """
    causes = [each for each in diagnosis["causes"] if each.get("log_evidence") is not None]
    if not any(each["effects"] == [] for each in causes):
        raise InputError(f"{case.name}: found no log_evidence in its answer, expected it; solve with this version")
    evidence = {tuple(sorted(each["effects"])): float(each["log_evidence"]) for each in causes}
    return Gap(laboratory, case, diagnosis["gap"]["p_value"], diagnosis["calibration"]["inside"], evidence)
