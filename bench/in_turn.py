"""How far evidence is to be trusted: tuned on all laboratories but one, scored on that one, in turn.

`python -m bench.in_turn FOLDER…`: sealed folders of several laboratories, answered; the truths are opened, and answers
weighed anew by the log evidence that they state (`bench.reweighed`). For every laboratory those settings of `Trust` are
taken that give the truths of the others' declared gaps the highest mean log probability; and the level of the answer
sets that holds 95 % of these truths (conformal calibration; Vovk, Gammerman and Shafer 2005), for gaps that an unknown
leads and for others by itself. What is printed is of the laboratory left out, beside the settings in force. A truth
with less than 1e-4, or that an answer does not list, counts as 1e-4.
"""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from itertools import product
from math import ceil
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from bench.one_line import one_line
from bench.reweighed import Gap, gaps_of
from probation.inference.calibration_check import CalibrationCheck, Trust
from probation.settings.evidence import EVIDENCE
from probation_studies.blind.scores.answer import UNKNOWN
from probation_studies.blind.scores.case import oracle_answer

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation_studies.blind.scores.answer import Names

LEAST = 1e-4
POWERS = (0.1, 0.2, 0.3, 0.4, 0.5)
LEFT_BY_FORMS = (0.0, 0.05)
DOUBTS = (0.0, 0.15, 0.3, 0.45, 0.6)
IN_DOUBT = (0.01, 0.02, 0.05)
STRONG_DOUBTS = (0.0, 0.15, 0.3)
MOST_UNKNOWN = (0.1, 0.2, 0.4)
HEAD = (
    "laboratory", "settings", "gaps", "mean log score", "said", "right", "level", "sets that hold the truth",
    "their size", "of the oracle's",
)  # fmt: skip


def settings() -> list[Trust]:
    """Those that are compared."""
    return [
        Trust(power, left, doubt, in_doubt, strong, 0.005, most)
        for power, left, doubt, in_doubt, strong, most in product(
            POWERS, LEFT_BY_FORMS, DOUBTS, IN_DOUBT, STRONG_DOUBTS, MOST_UNKNOWN
        )
        if doubt or in_doubt == IN_DOUBT[0]
    ]


@dataclass(frozen=True)
class Judged:
    """A gap's explanations under some settings, the most probable first.

    Attributes
    ----------
    gap : Gap
    ranked : list of tuple
        Explanations that were fitted.
    truth : float
        Probability that the answer states of it, of what was not tried as well.
    """

    gap: Gap
    ranked: list[tuple[Names, float]]
    truth: float

    @classmethod
    def of(cls, gap: Gap, trust: Trust) -> Judged:
        """By these settings."""
        found = gap.weighed(trust)
        stated = gap.stated(found)
        truth = sum(value for names, value in stated.items() if names in gap.case.admitted)
        return cls(gap, [(each.effects, each.probability) for each in found], truth)

    @property
    def log_score(self) -> float:
        """Log probability of the truth."""
        return float(np.log(max(self.truth, LEAST)))

    @property
    def right(self) -> bool:
        """Whether what leads is true."""
        return self.ranked[0][0] in self.gap.case.admitted

    @property
    def by_an_unknown(self) -> bool:
        """Whether an unknown leads."""
        return UNKNOWN in self.ranked[0][0]

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


def judged(gaps: Iterable[Gap], trust: Trust | None = None) -> list[Judged]:
    """All of them; by the settings in force, if there are none."""
    return [Judged.of(gap, trust or CalibrationCheck(gap.inside).trust) for gap in gaps]


def level_of(found: Sequence[Judged]) -> float:
    """Just above their conformal quantile; 1, all explanations, where there are too few."""
    rank = ceil((len(found) + 1) * EVIDENCE.credible_set)
    return min(np.nextafter(sorted(each.before for each in found)[rank - 1], 2.0), 1.0) if rank <= len(found) else 1.0


def row(laboratory: str, name: str, own: Sequence[Judged], level: Sequence[float]) -> list[str]:
    """What the settings come to there, with the level of each gap's answer set."""
    held = [each.before < most for each, most in zip(own, level, strict=True)]
    return [
        laboratory,
        name,
        str(len(own)),
        f"{np.mean([each.log_score for each in own]):.2f}",
        f"{np.mean([each.ranked[0][1] for each in own]):.2f}",
        f"{np.mean([each.right for each in own]):.2f}",
        " and ".join(f"{100.0 * each:.2f} %" for each in sorted({*level})),
        f"{100.0 * np.mean(held):.0f} %",
        f"{np.mean([each.size(most) for each, most in zip(own, level, strict=True)]):.1f}",
        f"{np.mean([len(oracle_answer(each.gap.case.truth).answer_set) for each in own]):.1f}",
    ]


def said(trust: Trust) -> str:
    """Settings in one line."""
    return (
        f"β {trust.power:g}, forms {trust.left_by_forms:g}, {trust.doubt:g} at {trust.power_in_doubt:g}, "
        f"{trust.strong_doubt:g} at {trust.power_in_strong_doubt:g}, unknown {trust.most_unknown:g}"
    )


def rows(gaps: Sequence[Gap]) -> list[list[str]]:
    """Two of each laboratory: the settings in force, and those of the others with their conformal levels."""
    of = {
        name: [gap for gap in gaps if gap.laboratory == name] for name in dict.fromkeys(gap.laboratory for gap in gaps)
    }
    compared = settings()
    scores = {
        name: np.array([[each.log_score for each in judged(own, trust)] for trust in compared])
        for name, own in of.items()
    }
    found = []
    for name, own in of.items():
        found.append(row(name, "in force", judged(own), [CalibrationCheck(gap.inside).covered for gap in own]))
        others = np.hstack([scores[other] for other in of if other != name])
        best = compared[int(np.argmax(others.mean(axis=1)))]
        theirs = judged((gap for gap in gaps if gap.laboratory != name), best)
        levels = [level_of([each for each in theirs if each.by_an_unknown == by]) for by in (False, True)]
        tuned = judged(own, best)
        found.append(row(name, said(best), tuned, [levels[each.by_an_unknown] for each in tuned]))
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="sealed folders of several laboratories, answered")
    folders = parser.parse_args().folders
    with one_line(parser):
        gaps = [gap for folder in folders for gap in gaps_of(folder)]
    if len({gap.laboratory for gap in gaps}) < 2:
        parser.error("found gaps of one laboratory, expected those of two at least: one is left out")
    lines = [HEAD, ("---",) * len(HEAD), *rows(gaps)]
    print("\n".join(f"| {' | '.join(line)} |" for line in lines))


if __name__ == "__main__":
    main()
