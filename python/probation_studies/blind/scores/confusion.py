"""What was taken for what."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from typing import TYPE_CHECKING

from probation_studies.blind.scores.answer import UNKNOWN

if TYPE_CHECKING:
    from probation_studies.blind.scores.answer import Names
    from probation_studies.blind.scores.case import Case

RIGHT_PAIR, WRONG_PAIR = "several, right", "several, other"
_LAST = ("several", RIGHT_PAIR, WRONG_PAIR, UNKNOWN, "with unknown", "mimic", "no_answer")


def label(names: Sequence[str]) -> str:
    """An explanation in one word."""
    return "+".join(names) or "none"


def confusion(cases: Sequence[Case]) -> dict[str, dict[str, int]]:
    """For every truth, how often every answer was the most probable one; most frequent first."""
    counts: dict[str, Counter[str]] = {}
    for case in cases:
        counts.setdefault(label(case.explanation), Counter())[label(case.answer.top)] += 1
    return {truth: dict(counts[truth].most_common()) for truth in sorted(counts)}


def confusion_matrix(cases: Sequence[Case]) -> dict[str, object]:
    """The same with all sets of several effects together.

    Returns
    -------
    dict
        "truths" and "answers" (labels of rows and columns) and "counts" (rows of numbers).
    """
    pairs = Counter((_row(case), _column(case)) for case in cases)
    rows = _ordered({row for row, _ in pairs})
    columns = _ordered({column for _, column in pairs} | {row for row in rows if row not in ("several", "mimic")})
    return {"truths": rows, "answers": columns, "counts": [[pairs[row, column] for column in columns] for row in rows]}


def _row(case: Case) -> str:
    if case.stratum == "mimic":
        return "mimic"
    return "several" if len(case.explanation) > 1 else label(case.explanation)


def _column(case: Case) -> str:
    names: Names = case.answer.top
    if len(names) < 2:
        return label(names)
    if UNKNOWN in names:
        return "with unknown"
    return RIGHT_PAIR if case.right else WRONG_PAIR


def _ordered(labels: set[str]) -> list[str]:
    """None first, effects by name, then what is no single effect."""

    def place(each: str) -> tuple[int, str]:
        return (0, "") if each == "none" else (2 + _LAST.index(each), "") if each in _LAST else (1, each)

    return sorted(labels, key=place)
