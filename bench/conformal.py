"""Answer sets whose level is learned on other laboratories (conformal calibration): do they hold on the one left out?

`python -m bench.conformal FOLDER…`: sealed folders of one laboratory each, answered. A gap's score is the probability
of all explanations down to its true one. The level is the 95 % quantile of the scores of the other laboratories (Vovk,
Gammerman and Shafer 2005), so that 95 % of new gaps like those are held.
"""

from __future__ import annotations

import argparse
import json
from math import ceil
from pathlib import Path

import numpy as np

from probation.settings.evidence import EVIDENCE
from probation_studies.blind.scores.answer import read_answer
from probation_studies.blind.scores.case import Case

HEAD = (
    "laboratory", "gaps that were declared", "held as the answers are", "mean size", "level by the other laboratories",
    "held at that level", "mean size there", "of the oracle's sets",
)  # fmt: skip


def gaps(folder: Path) -> list[Case]:
    """Declared gaps with a cause."""
    found = []
    for path in sorted((folder / "answers").glob("*-[0-9]*.json")):
        answer = json.loads(path.read_text())
        truth = json.loads(json.loads((folder / "truths" / path.name).read_text())["truth"])
        if truth["causes"] and "diagnosis" in answer:
            case = Case(truth["name"], truth, read_answer(answer["diagnosis"], path.name))
            found += [case] if case.answer.gap else []
    return found


def ranked(case: Case) -> list[tuple[tuple[str, ...], float]]:
    """Explanations, the most probable first."""
    return sorted(case.answer.probability.items(), key=lambda each: -each[1])


def score(case: Case) -> float:
    """Probability down to the truth; more than all where it is not among the explanations."""
    total = 0.0
    for names, probability in ranked(case):
        total += probability
        if names in case.admitted:
            return total
    return 2.0


def size(case: Case, level: float) -> int:
    """Of the set that holds so much."""
    total = np.cumsum([probability for _, probability in ranked(case)])
    return min(int(np.searchsorted(total, level)) + 1, len(total))


def level_of(scores: list[float]) -> float:
    """Their conformal quantile; 1, all explanations, where there are too few."""
    rank = ceil((len(scores) + 1) * EVIDENCE.credible_set)
    return min(sorted(scores)[rank - 1], 1.0) if rank <= len(scores) else 1.0


def rows(folders: list[Path]) -> list[list[str]]:
    """One of each laboratory."""
    cases = {folder.name: gaps(folder) for folder in folders}
    found = []
    for name, own in cases.items():
        level = level_of([score(case) for other, each in cases.items() if other != name for case in each])
        held = np.mean([score(case) <= level + 1e-12 for case in own])
        found.append(
            [
                name,
                str(len(own)),
                f"{100.0 * np.mean([case.covered for case in own]):.0f} %",
                f"{np.mean([len(case.answer.answer_set) for case in own]):.1f}",
                f"{100.0 * level:.2f} %",
                f"{100.0 * held:.0f} %",
                f"{np.mean([size(case, level) for case in own]):.1f}",
                f"{np.mean([len(case.oracle['answer_set']) for case in own]):.1f}",
            ]
        )
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path, help="sealed folders of one laboratory each, answered")
    lines = [HEAD, ("---",) * len(HEAD), *rows(parser.parse_args().folders)]
    print("\n".join(f"| {' | '.join(line)} |" for line in lines))


if __name__ == "__main__":
    main()
