"""Keyword input: Abaqus' lists of numbers (CalculiX has the same), and what stands under a keyword."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.exporting.numbers import within

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

NUMBER_WIDTH = 20
"""Characters that Abaqus and CalculiX read of a number."""

PER_LINE = 8
"""Numbers that they read on a line."""


def listed(values: Sequence[float], per_line: int = PER_LINE) -> str:
    """Numbers, so many to a line."""
    texts = [within(value, NUMBER_WIDTH) for value in values]
    rows = [texts[at : at + per_line] for at in range(0, len(texts), per_line)]
    return "".join(", ".join(row) + "\n" for row in rows)


def blocks(text: str, comment: str) -> Iterator[tuple[str, list[str]]]:
    """Keyword lines, upper-case without blanks, each with the data lines below it."""
    keyword, data = "", list[str]()
    for line in text.splitlines():
        if line.startswith(comment) or not line.strip():
            continue
        if line.startswith("*"):
            if keyword:
                yield keyword, data
            keyword, data = line.upper().replace(" ", ""), []
        else:
            data.append(line)
    if keyword:
        yield keyword, data


def data_under(text: str, keyword: str, comment: str = "**") -> list[str]:
    """The data lines of the first block that begins so.

    Raises
    ------
    InputError
        If there is none.
    """
    for found, data in blocks(text, comment):
        if found.startswith(keyword):
            return data
    raise InputError(f"found no {keyword} in the text, expected one")


def numbers(lines: Sequence[str]) -> list[float]:
    """Numbers between commas."""
    return [float(entry) for line in lines for entry in line.split(",") if entry.strip()]
