"""What an outcome means: read, refused, or a failure of the program."""

from __future__ import annotations

import json
import re
import unicodedata
from dataclasses import dataclass
from pathlib import PurePosixPath
from typing import TYPE_CHECKING

from fuzz.worker import MOST_PRINTED
from probation._text import printable

if TYPE_CHECKING:
    from fuzz.case import Case
    from fuzz.pool import Outcome

READ, REFUSED, FAILURE = "read", "refused", "failure"
TOLERANCE = 1e-6
"""Largest error of what is read, in parts of the largest true value: cases are written with nine digits."""

_DONE, _BAD_INPUT = 0, 2
_LIBRARY_WARNINGS = re.compile(
    r"encountered in|Mean of empty slice|Degrees of freedom|could not be estimated|[Ii]ll-conditioned|On entry to|"
    r"RuntimeWarning|DeprecationWarning|UserWarning|ResourceWarning|FutureWarning|Polyfit|"
    r"Exception ignored|All-NaN"
)
_BIDI = frozenset("\u061c\u200e\u200f\u2028\u2029\u202a\u202b\u202c\u202d\u202e\u2066\u2067\u2068\u2069")


@dataclass(frozen=True)
class Verdict:
    """What an outcome means.

    Attributes
    ----------
    answer : str
        "read", "refused" or "failure".
    failure : str
        Which kind of failure; empty otherwise.
    detail : str
        What was found, for people.
    """

    answer: str
    failure: str = ""
    detail: str = ""

    @property
    def signature(self) -> str:
        """Equal for failures that look alike: numbers, names and quoted text are left out."""
        detail = re.sub(r"'[^']*'|\"[^\"]*\"|[^\s']*[/\\.][^\s]*|[-+]?\d[\w.]*", "…", self.detail)
        return f"{self.failure}: {detail[:100]}"


def judge(case: Case, outcome: Outcome) -> Verdict:
    """Judge one outcome."""
    verdict = _breakdown(case, outcome) or _print(outcome) or _by_status(case, outcome)
    if case.outcome and verdict.answer not in (case.outcome, FAILURE):
        return Verdict(FAILURE, f"{verdict.answer} and not {case.outcome}", _last(outcome))
    return verdict


def _breakdown(case: Case, outcome: Outcome) -> Verdict | None:
    """Whether the program broke."""
    if outcome.ended.startswith("stopped"):
        return Verdict(FAILURE, "hang", f"{case.command[0]} took more than {outcome.seconds:g} s")
    if outcome.status is None:
        return Verdict(FAILURE, "crash", outcome.ended)
    if "Traceback (most recent call last)" in outcome.err + outcome.out:
        return Verdict(FAILURE, "traceback", _last(outcome))
    if outcome.status != _DONE and _last(outcome).startswith("probation: unexpected"):
        return Verdict(FAILURE, "unexpected error", _last(outcome))
    return None


def _print(outcome: Outcome) -> Verdict | None:
    """Whether something is printed that no user should see."""
    if max(len(outcome.out), len(outcome.err)) > MOST_PRINTED:
        return Verdict(FAILURE, "flood", f"more than {MOST_PRINTED} characters are printed")
    for text in (outcome.out, outcome.err):
        if (character := _control(text)) is not None:
            return Verdict(FAILURE, "control character", f"{character!r} is printed as it stands in the file")
    if found := _LIBRARY_WARNINGS.search(outcome.err):
        line = outcome.err[: found.end()].count("\n")
        return Verdict(FAILURE, "warning of a library", outcome.err.splitlines()[line])
    return None


def _by_status(case: Case, outcome: Outcome) -> Verdict:
    if outcome.status == _DONE:
        return _against_answer(case, outcome) or _against_truth(case, outcome)
    if outcome.status == _BAD_INPUT:
        return _complaint(case, outcome)
    if "did not converge" in _last(outcome):
        return Verdict(REFUSED)
    return Verdict(FAILURE, f"status {outcome.status}", _last(outcome))


def _complaint(case: Case, outcome: Outcome) -> Verdict:
    """Whether a refusal is one line that names the file, and nothing else."""
    lines = outcome.err.splitlines()
    if len(lines) != 1 or not lines[0].startswith("probation: "):
        return Verdict(FAILURE, f"{len(lines)} lines of complaint", " | ".join(lines[:4]))
    if outcome.out.strip():
        return Verdict(FAILURE, "an answer beside the complaint", outcome.out[:100])
    if not _names_input(case, lines[0]):
        return Verdict(FAILURE, "a complaint that names no file", lines[0])
    return Verdict(REFUSED)


def _last(outcome: Outcome) -> str:
    return (outcome.err.strip().splitlines() or [""])[-1]


def _names_input(case: Case, complaint: str) -> bool:
    """Whether a complaint names a file of the case, an option, or a file or record that a campaign names."""
    tops = {PurePosixPath(name).parts[0] for name in case.files}
    stores = {name for name in tops if name not in case.files}
    shown = {printable(" ".join(name.split())) for name in tops - stores}
    names = stores | {name.split(".")[0] for name in shown} | {case.command[1].split("/")[-1][:30], "--"}
    place = complaint.removeprefix("probation: ").partition(":")[0]
    said = (place, *re.findall("'([^']+)'", place))  # the record that is named, too
    texts = [content for content in case.files.values() if isinstance(content, str)]
    quoted = any(each in content for each in said for content in texts)
    return quoted or any(name in complaint for name in names if len(name) > 1)


def _control(text: str) -> str | None:
    for character in set(text):
        if character in _BIDI or (unicodedata.category(character) == "Cc" and character not in "\n\t"):
            return character
    return None


def _against_answer(case: Case, outcome: Outcome) -> Verdict | None:
    """Whether a damaged store gave another answer than the one that was stored."""
    told = json.loads(outcome.out) if case.answer else {}
    for key, right in case.answer.items():
        if told.get(key) != right:
            return Verdict(
                FAILURE, "wrong values", f"{key}: {json.dumps(told.get(key))[:60]}, expected {json.dumps(right)[:60]}"
            )
    return None


def _against_truth(case: Case, outcome: Outcome) -> Verdict:
    """Whether what was read is what the file says, or the doubt was told."""
    if case.truth is None:
        return Verdict(READ)
    records = json.loads(outcome.out)
    if len(records) != 1:
        return Verdict(FAILURE, "wrong values", f"{len(records)} records, expected one")
    samples, warnings = records[0]["samples"], " ".join(records[0]["warnings"]).casefold()
    for quantity, true in case.truth.items():
        found = samples.get(quantity)
        if found is not None and _equal(found, true):
            continue
        words = case.doubts.get(quantity, [quantity])
        told = "unit" in warnings and any(word.casefold() in warnings for word in words)
        if told or (found is None and quantity not in ("time", "true_strain", "true_stress")):
            continue
        shown = "none" if found is None else f"{len(found)} values up to {max(found, key=abs):.6g}"
        said = f"{quantity} of {words[0]}: {shown}, expected {len(true)} up to {max(true, key=abs):.6g}"
        return Verdict(FAILURE, "wrong values", said)
    return Verdict(READ)


def _equal(found: list[float], true: list[float]) -> bool:
    largest = max(map(abs, true)) or 1.0
    return len(found) == len(true) and all(abs(a - b) <= TOLERANCE * largest for a, b in zip(found, true, strict=True))
