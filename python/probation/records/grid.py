"""Text to cells: separator found, quotes undone, every row remembering where it stood."""

import csv
import io
import re
from collections.abc import Sequence
from dataclasses import dataclass

from probation._complaint import bad_input
from probation.records.source import Source

SEPARATORS = {";": "semicolon", "\t": "tab", ",": "comma"}
_SNIFFED_LINES = 200
_NUMBER = re.compile(r"[+-]?(\d+([.,]\d*)?|[.,]\d+)([eE][+-]?\d+)?|[+-]?(nan|inf|infinity)", re.IGNORECASE)
_WITH_COMMA = re.compile(r"^\s*[+-]?\d*,\d+([eE][+-]?\d+)?\s*$", re.MULTILINE)
_WITH_POINT = re.compile(r"^\s*[+-]?\d*\.\d+([eE][+-]?\d+)?\s*$", re.MULTILINE)


@dataclass(frozen=True)
class Grid:
    """The cells of a file; wholly empty lines are left out.

    Attributes
    ----------
    rows : list of list of str
        Cells as they stand, rows possibly of different length.
    row_numbers : list of int
        The file's row of each, counted from 1 as an editor shows it.
    separator : str
        Name of the separator, for people: "comma", "semicolon", "tab", "Excel sheet 'x'".
    """

    rows: list[list[str]]
    row_numbers: list[int]
    separator: str


def read_grid(source: Source) -> Grid:
    """Split delimited text into cells.

    Raises
    ------
    InputError
        If no line holds a separator, or a quote is never closed.
    """
    text = source.text.replace("\r\n", "\n").replace("\r", "\n")
    separator = sniff_separator(text)
    if separator is None:
        raise bad_input(
            source.path,
            "a single column",
            "values separated by comma, semicolon or tab",
            row=1,
            remedy="export the table as CSV",
        )
    rows: list[list[str]] = []
    row_numbers: list[int] = []
    reader = csv.reader(io.StringIO(text, newline="\n"), delimiter=separator, skipinitialspace=True)
    last_line = 0
    try:
        for row in reader:
            if row:
                rows.append(row)
                row_numbers.append(last_line + 1)
            last_line = reader.line_num
    except csv.Error as failure:
        raise bad_input(
            source.path,
            f"text that is no CSV ({failure})",
            "quotes that close on their own row",
            row=last_line + 1,
        ) from None
    return Grid(rows=rows, row_numbers=row_numbers, separator=SEPARATORS[separator])


def sniff_separator(text: str) -> str | None:
    """Find the separator that splits the most lines into numbers.

    Ties go to the semicolon, then the tab: with either, a comma inside a number is a decimal comma.
    """
    lines = [line for line in text.split("\n") if line.strip()]
    sample = lines[:_SNIFFED_LINES] + lines[_SNIFFED_LINES:][-_SNIFFED_LINES:]
    scores = {separator: _number_share(sample, separator) for separator in SEPARATORS}
    best = max(scores, key=lambda separator: scores[separator])
    if scores[best] > 0:
        return best
    counts = {separator: sample[0].count(separator) for separator in SEPARATORS}
    most = max(counts, key=lambda separator: counts[separator])
    return most if counts[most] else None


def _number_share(lines: Sequence[str], separator: str) -> float:
    """Sum over the lines of the share of filled cells that are numbers."""
    total = 0.0
    for line in lines:
        cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        filled = [cell for cell in cells if cell.strip()]
        if len(cells) > 1 and filled:
            total += sum(map(is_number, filled)) / len(filled)
    return total


def is_number(cell: str) -> bool:
    """Tell whether a cell is meant as a number, NaN and decimal commas included."""
    return _NUMBER.fullmatch(cell.strip()) is not None


def decimal_mark(rows: Sequence[Sequence[str]]) -> str:
    """Find the decimal mark of the cells: the comma only where no cell uses the point."""
    cells = "\n".join("\n".join(row) for row in rows)
    return "," if _WITH_COMMA.search(cells) and not _WITH_POINT.search(cells) else "."
