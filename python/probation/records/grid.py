"""Text to cells: separator found, quotes undone, every row remembering where it stood."""

import csv
import io
import re
from collections import Counter
from collections.abc import Sequence
from dataclasses import dataclass

from probation._complaint import bad_input
from probation.limits import CELL_CHARACTERS, CELLS, COLUMNS, LINE_CHARACTERS, ROWS
from probation.records.cell import is_sample
from probation.records.source import Source

SEPARATORS = {";": "semicolon", "\t": "tab", ",": "comma"}
BLANKS = "blanks"
_SNIFFED_LINES = 200
"""First and last lines of a text by which its separator is recognised."""
_NAME_AND_UNIT = re.compile(r"[^\s(\[]+(?:\s*[(\[][^)\]]*[)\]])?")


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
        Name of the separator, for people: "comma", "semicolon", "tab", "blanks", "Excel sheet 'x'".
    """

    rows: list[list[str]]
    row_numbers: list[int]
    separator: str


def read_grid(source: Source) -> Grid:
    """Split delimited text into cells.

    Raises
    ------
    InputError
        If no line holds a separator, a quote is never closed, or a limit is exceeded.
    """
    text = source.text.replace("\r\n", "\n").replace("\r", "\n")
    _check_lines(source, text)
    separator = sniff_separator(text)
    if separator is None:
        raise bad_input(
            source.path,
            "a single column",
            "values separated by comma, semicolon, tab or blanks",
            row=1,
            remedy="export the table as CSV",
        )
    known = SEPARATORS.get(separator, separator)
    if separator == BLANKS:
        text, separator = _with_tabs(text), "\t"
    rows: list[list[str]] = []
    row_numbers: list[int] = []
    reader = csv.reader(io.StringIO(text, newline="\n"), delimiter=separator, skipinitialspace=True)
    last_line = cells = 0
    try:
        for row in reader:
            if row:
                rows.append(row)
                row_numbers.append(last_line + 1)
                cells += len(row)
                check_extent(source, last_line + 1, len(row), cells)
            last_line = reader.line_num
    except csv.Error as failure:
        too_long = f"a cell of more than {CELL_CHARACTERS} characters" if "field limit" in str(failure) else ""
        raise bad_input(
            source.path,
            f"text that is no CSV ({too_long or failure})",
            "quotes that close on their own row",
            row=last_line + 1,
        ) from None
    return Grid(rows=rows, row_numbers=row_numbers, separator=known)


def _check_lines(source: Source, text: str) -> None:
    """Refuse a flood of lines, or an endless one, before anything is split."""
    if text.count("\n") > ROWS:
        check_extent(source, ROWS + 1, 0, 0)
    for number, line in enumerate(text.split("\n"), start=1):
        if len(line) > LINE_CHARACTERS:
            raise bad_input(
                source.path,
                f"a line of {len(line)} characters",
                f"at most {LINE_CHARACTERS}",
                row=number,
                remedy="write one row of the table on each line",
            )


def check_extent(source: Source, row: int, columns: int, cells: int) -> None:
    """Refuse a table beyond the limits, while it is read.

    Parameters
    ----------
    row : int
        Of the file, counted from 1.
    columns : int
        Cells of this row.
    cells : int
        Of all rows so far.

    Raises
    ------
    InputError
        Naming the row.
    """
    for count, most, what in ((row, ROWS, "rows"), (columns, COLUMNS, "columns"), (cells, CELLS, "cells")):
        if count > most:
            raise bad_input(
                source.path,
                f"more than {most} {what}",
                f"at most {most}",
                row=row,
                remedy="keep fewer samples, or only the columns that are used",
            )


def sniff_separator(text: str) -> str | None:
    """Find the separator that splits the most lines into numbers.

    Ties go to the semicolon, then the tab: with either, a comma inside a number is a decimal comma. `BLANKS` separate
    only where most lines are nothing but numbers then, and no other separator does as well.
    """
    lines = [line for line in text.split("\n") if line.strip()]
    sample = lines[:_SNIFFED_LINES] + lines[_SNIFFED_LINES:][-_SNIFFED_LINES:]
    scores = {separator: _number_share(sample, separator) for separator in SEPARATORS}
    best = max(scores, key=lambda separator: scores[separator])
    blank = sum(_numbers_alone(line) for line in sample)
    if blank > max(scores[best], 0.5 * len(sample)):
        return BLANKS
    if scores[best] > 0:
        return best
    counts = {separator: sample[0].count(separator) for separator in SEPARATORS}
    most = max(counts, key=lambda separator: counts[separator])
    return most if counts[most] else None


def _numbers_alone(line: str) -> bool:
    """Whether there is nothing but samples between blanks, two at least."""
    cells = line.split()
    return len(cells) > 1 and all(map(is_sample, cells))


def _with_tabs(text: str) -> str:
    """A table whose columns stand apart by blanks, with tabs in their place; lines stay where they are."""
    lines = text.split("\n")
    counts = Counter(len(line.split()) for line in lines if _numbers_alone(line))
    columns = counts.most_common(1)[0][0]
    return "\n".join("\t".join(_cells(line, columns)) for line in lines)


def _cells(line: str, columns: int) -> list[str]:
    """The cells of a line; a heading may hold blanks, if only that gives as many cells as the numbers have.

    Any other line is a remark, and one cell.
    """
    if _numbers_alone(line):
        return line.split()
    heading = line.strip().lstrip("#%").strip()
    ways = (heading.split(), re.split(r"\s{2,}|\t+", heading), _NAME_AND_UNIT.findall(heading))
    return next((cells for cells in ways if len(cells) == columns), [line.strip()])


def _number_share(lines: Sequence[str], separator: str) -> float:
    """Sum over the lines of the share of filled cells that are numbers."""
    total = 0.0
    for line in lines:
        try:
            cells = next(csv.reader([line], delimiter=separator, skipinitialspace=True), [])
        except csv.Error:  # a cell beyond the limit: `read_grid` names its row
            continue
        filled = [cell for cell in cells if cell.strip()]
        if len(cells) > 1 and filled:
            total += sum(map(is_sample, filled)) / len(filled)
    return total
