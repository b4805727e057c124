"""How far evidence is to be trusted where forms are others: found on all laboratories but one, scored on that one.

`python -m bench.in_turn FOLDER…`: sealed folders of several laboratories, answered; the truths are opened, and answers
weighed anew by the log evidence that they state (`bench.reweighed`). The six numbers of `OtherForms` are those that
give the truths of the other laboratories' declared gaps the highest probability. What is printed is of the laboratory
left out, beside the weights in force; then of all together, and the weights that all folders tell. "Said" and "right"
are of what leads in declared gaps, and so is the calibration error.

Then the level of the answer sets that holds 95 % of the others' truths (conformal calibration; Vovk, Gammerman and
Shafer 2005), in strata by what the best explanation gains. It is of truths that an answer lists: no level holds others,
and they are one in seven. A truth with less than 1e-4, or that an answer does not list, counts as 1e-4 in the score.
What held-out records refuse stays in.
"""

from __future__ import annotations

import argparse
from dataclasses import astuple, dataclass, replace
from functools import cached_property
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import minimize

from bench.answered import answered
from bench.laboratories import NAMED, calibration_error, named, rate, scored
from bench.one_line import one_line
from bench.reweighed import Gap, declared, gap_in
from probation.diagnosis.trust import OtherForms, trust_in
from probation.inference.calibration_check import CalibrationCheck
from probation.settings.calibrated import CALIBRATED
from probation.settings.evidence import EVIDENCE
from probation_studies.blind.layout import Layout
from probation_studies.blind.scores.intervals import Rate
from probation_studies.blind.scores.probabilities import reliability

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation.diagnosis.trust import Trust
    from probation_studies.blind.scores.answer import Names
    from probation_studies.blind.scores.case import Case

LEAST = 1e-4
GAINS = (100.0, 1000.0)
"""Log evidence between strata."""
START = OtherForms(
    fall_with_distance=0.5, unknown_power=0.01, two=0.1, three=0.01, unknown=0.1, unknown_with_known=0.001
)
HEAD = (
    "laboratory left out", "weights", "campaigns", *NAMED, "calibration error", "said", "right", "mean log score",
)  # fmt: skip
STRATA = (
    "laboratory left out", "the best explanation gains", "truths that are listed", "of these 95 % sets hold",
    "their size", "level that holds 95 % of the others'", "its sets hold", "their size",
)  # fmt: skip


@dataclass(frozen=True)
class Judged:
    """A gap's explanations under some weights, the most probable first.

    Attributes
    ----------
    gap : Gap
    ranked : list of tuple
        Explanations that were fitted.
    stated : dict
        What the answer states, of what was not tried as well.
    """

    gap: Gap
    ranked: list[tuple[Names, float]]
    stated: dict[Names, float]

    @classmethod
    def of(cls, gap: Gap, trust: Trust) -> Judged:
        """By these weights."""
        found = gap.weighed(trust)
        return cls(gap, [(each.effects, each.probability) for each in found], gap.stated(found))

    @property
    def log_score(self) -> float:
        """Log probability of the truth."""
        truth = sum(value for names, value in self.stated.items() if names in self.gap.case.admitted)
        return float(np.log(max(truth, LEAST)))

    @property
    def right(self) -> bool:
        """Whether what leads is true."""
        return self.ranked[0][0] in self.gap.case.admitted

    @property
    def before(self) -> float:
        """Probability of all that come before the truth; 1 where it is not among them.

        A set holds the truth where this is below its level: it ends with the explanation that reaches it.
        """
        total = 0.0
        for names, value in self.ranked:
            if names in self.gap.case.admitted:
                return total
            total += value
        return 1.0

    def size(self, level: float) -> int:
        """Of the set that holds so much."""
        return min(int(np.searchsorted(np.cumsum([value for _, value in self.ranked]), level)) + 1, len(self.ranked))

    @property
    def case(self) -> Case:
        """The campaign as these weights answer it."""
        held = tuple(names for names, _ in self.ranked[: self.size(EVIDENCE.credible_set)])
        return replace(self.gap.case, answer=replace(self.gap.case.answer, probability=self.stated, answer_set=held))


@dataclass(frozen=True)
class Answered:
    """The answered campaigns of a laboratory.

    Attributes
    ----------
    laboratory : str
    cases : list of Case
    gaps : list of Gap
        Declared ones that have a cause, outside the calibrated ranges.
    """

    laboratory: str
    cases: list[Case]
    gaps: list[Gap]

    @cached_property
    def others(self) -> list[Case]:
        """Cases that no weights of other forms change."""
        weighed = {id(gap.case) for gap in self.gaps}
        return [case for case in self.cases if id(case) not in weighed]


def answered_in(folders: Iterable[Path]) -> list[Answered]:
    """By laboratory."""
    found: dict[str, Answered] = {}
    for folder in folders:
        layout = Layout(folder)
        name = str(layout.published()[0].get("laboratory", "own"))
        own = found.setdefault(name, Answered(name, [], []))
        for case, diagnosis in answered(layout):
            own.cases.append(case)
            if declared(case, diagnosis) and not diagnosis["calibration"]["inside"]:
                own.gaps.append(gap_in(name, case, diagnosis))
    return list(found.values())


def judged(gaps: Iterable[Gap], trust: Trust | None = None) -> list[Judged]:
    """All of them; by the weights in force, if there are none."""
    return [Judged.of(gap, trust or trust_in(CalibrationCheck(gap.inside))) for gap in gaps]


def found_on(gaps: Sequence[Gap]) -> OtherForms:
    """The weights that give the truths of these gaps the highest probability, where they were fitted.

    What gaps tell nothing of stays where it is: beforehand the logarithms have a standard deviation of 1 about `START`.
    """
    told = [gap for gap in gaps if any(names in gap.log_evidence for names in gap.case.admitted)]

    def weights(numbers: np.ndarray) -> OtherForms:
        return OtherForms(*np.exp(numbers))

    def loss(numbers: np.ndarray) -> float:
        off = numbers - start
        return 0.5 * float(off @ off) - sum(_log_chance(gap, weights(numbers)) for gap in told)

    start = np.log(astuple(START)[:-1])
    return replace(weights(minimize(loss, start).x), most_unknown=CALIBRATED.most_unknown_outside)


def _log_chance(gap: Gap, trust: OtherForms) -> float:
    """Log probability of the truth among the explanations that were fitted, "no effect" not among them."""
    scores = trust.log_weights(gap.log_evidence, gap.log_odds, gap.count)
    some = [(names, score) for names, score in zip(gap.log_evidence, scores, strict=True) if names]
    true = np.logaddexp.reduce([score for names, score in some if names in gap.case.admitted])
    return float(true - np.logaddexp.reduce([score for _, score in some]))


def level_of(found: Iterable[Judged]) -> float:
    """Just above the conformal quantile of those that list their truth; 1, all explanations, of too few."""
    listed = sorted(each.before for each in found if each.before < 1.0)
    rank = ceil((len(listed) + 1) * EVIDENCE.credible_set)
    return min(np.nextafter(listed[rank - 1], 2.0), 1.0) if rank <= len(listed) else 1.0


def row(own: Answered, name: str, found: Sequence[Judged]) -> list[str]:
    """Scores of a laboratory under some weights."""
    scores = scored(own.laboratory, [*own.others, *(each.case for each in found)])["scores"]["answers"]
    return [
        own.laboratory,
        name,
        str(len(own.cases)),
        *named(scores),
        calibration_error(reliability([each.case for each in found])),
        f"{np.mean([max(each.stated.values()) for each in found]):.2f}",
        f"{np.mean([each.right for each in found]):.2f}",
        f"{np.mean([each.log_score for each in found]):.2f}",
    ]


def gain(gap: Gap) -> float:
    """Log evidence of the best explanation over none."""
    return max(gap.log_evidence.values()) - gap.log_evidence[()]


def stratum_of(found: Judged) -> str:
    """By what its best explanation gains."""
    own = gain(found.gap)
    below = [f"less than {most:g}" for most in GAINS if own < most]
    return below[0] if below else f"{GAINS[-1]:g} or more"


def stratum_row(laboratory: str, name: str, own: Sequence[Judged], level: float) -> list[str]:
    """What sets of 95 % and of a level hold in a stratum, of truths that are listed."""
    listed = [each for each in own if each.before < 1.0]

    def held(most: float) -> list[str]:
        told = rate(Rate.of(each.before < most for each in listed).plain())
        return [told, f"{np.mean([each.size(most) for each in own]):.1f}"]

    return [
        laboratory,
        name,
        rate(Rate.of(each.before < 1.0 for each in own).plain()),
        *held(EVIDENCE.credible_set),
        f"{100.0 * level:.1f} %",
        *held(level),
    ]


def said(trust: OtherForms) -> str:
    """Weights in one line."""
    return (
        f"a {trust.fall_with_distance:.2f}, b {trust.unknown_power:.2g}, two {trust.two:.2g}, three {trust.three:.2g}, "
        f"unknown {trust.unknown:.2g}, with known {trust.unknown_with_known:.2g}"
    )


def tables(laboratories: Sequence[Answered]) -> tuple[list[list[str]], list[list[str]]]:
    """Scores of each laboratory by the weights in force and by those of the others; sets of each stratum."""
    scores, strata, whole = [], [], []
    for own in laboratories:
        theirs = [gap for other in laboratories if other is not own for gap in other.gaps]
        trust = found_on(theirs)
        here, there = judged(own.gaps, trust), judged(theirs, trust)
        whole += here
        scores += [row(own, "in force", judged(own.gaps)), row(own, f"of the others: {said(trust)}", here)]
        for name in dict.fromkeys(map(stratum_of, sorted(here, key=lambda each: gain(each.gap)))):
            level = level_of(each for each in there if stratum_of(each) == name)
            strata.append(stratum_row(own.laboratory, name, [each for each in here if stratum_of(each) == name], level))
    cases = [case for own in laboratories for case in own.cases]
    every = Answered("all", cases, [gap for own in laboratories for gap in own.gaps])
    return [*scores, row(every, "in force", judged(every.gaps)), row(every, "of the others", whole)], strata


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="sealed folders of several laboratories, answered")
    folders = parser.parse_args().folders
    with one_line(parser):
        laboratories = answered_in(folders)
    laboratories = [each for each in laboratories if each.gaps]
    if len(laboratories) < 2:
        parser.error("found gaps of one laboratory, expected those of two at least: one is left out")
    scores, strata = tables(laboratories)
    whole = found_on([gap for own in laboratories for gap in own.gaps])
    for lines in ([HEAD, ("---",) * len(HEAD), *scores], [STRATA, ("---",) * len(STRATA), *strata]):
        print("\n".join(f"| {' | '.join(line)} |" for line in lines), end="\n\n")
    print(f"On all: {said(whole)}.")


if __name__ == "__main__":
    main()
