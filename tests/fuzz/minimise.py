"""A failing case to a smaller one that fails alike."""

from __future__ import annotations

import re
from dataclasses import replace
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from fuzz.case import Case

MOST_TRIALS = 400
"""Runs that one case may take."""
_TOKENS = re.compile(r"([,;\t= ]+|[\[\]{}\"])")


def minimised(case: Case, fails_alike: Callable[[Case], bool]) -> Case:
    """Leave out files, then lines, then pieces of lines, as long as the case fails alike.

    A case with a truth stays as it is: its lines are what the truth was made of.
    """
    trials = 0

    def fails(candidate: Case) -> bool:
        nonlocal trials
        trials += 1
        return trials <= MOST_TRIALS and fails_alike(candidate)

    if case.truth is not None or case.answer:
        return case
    for name in list(case.files):
        fewer = replace(case, files={key: content for key, content in case.files.items() if key != name})
        if name not in case.command and fails(fewer):
            case = fewer
    for name, content in list(case.files.items()):
        if isinstance(content, str):
            case = _with_less_text(case, name, fails)
        if isinstance(content, dict) and "zip" in content:
            case = _without_members(case, name, fails)
    return case


def _with_less_text(case: Case, name: str, fails: Callable[[Case], bool]) -> Case:
    def fails_with(parts: Sequence[str]) -> bool:
        return fails(_with(case, name, "".join(parts)))

    lines = _fewest(_lines(case.files[name]), fails_with)
    pieces = _fewest(_pieces("".join(lines)), fails_with)
    return _with(case, name, "".join(pieces))


def _with(case: Case, name: str, content: object) -> Case:
    return replace(case, files={**case.files, name: content})


def _without_members(case: Case, name: str, fails: Callable[[Case], bool]) -> Case:
    for member in list(case.files[name]["zip"]):
        fewer = {key: text for key, text in case.files[name]["zip"].items() if key != member}
        if fails(candidate := _with(case, name, {"zip": fewer})):
            case = candidate
    return case


def _lines(text: str) -> list[str]:
    return text.splitlines(keepends=True)


def _pieces(text: str) -> list[str]:
    pieces = [piece for piece in _TOKENS.split(text) if piece]
    long = [piece for piece in pieces if len(piece) > 40]
    if not long:
        return pieces
    return [part for piece in pieces for part in ([piece] if len(piece) <= 40 else _cut(piece))]


def _cut(text: str) -> list[str]:
    size = max(1, len(text) // 32)
    return [text[at : at + size] for at in range(0, len(text), size)]


def _fewest(parts: Sequence[str], fails: Callable[[Sequence[str]], bool]) -> Sequence[str]:
    """Leave out runs of parts, half of them first, then shorter and shorter ones."""
    size = len(parts) // 2
    while size >= 1:
        at = 0
        while at < len(parts):
            fewer = [*parts[:at], *parts[at + size :]]
            if fails(fewer):
                parts = fewer
            else:
                at += size
        size //= 2
    return parts
