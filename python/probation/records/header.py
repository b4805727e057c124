"""Where a table's headings stand, what units they give, and where its numbers begin."""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass

from probation.records.cell import is_number, is_sample
from probation.records.grid import Grid
from probation.records.roles import QUANTITY_NAMES, normalised, role_of, split_suffix
from probation.records.table import Column
from probation.records.units import is_percent, is_unit, measures

_SEARCHED_ROWS = 400
"""Rows in which headings are looked for: exports have pages of text above them."""
_LABORATORY_UNITS = ("s", "mm", "N", "MPa", "1/s")
_BRACKETED = re.compile(r"(.*?)\s*[(\[]([^()\[\]]*)[)\]]\s*")
_BRACKETED_ALONE = re.compile(r"[(\[](.*)[)\]]")
_SLASHED = re.compile(r"([^/]*[^/\s])\s*/\s*(\S{1,12})")
_TRAILING = re.compile(r"(.*?[^\s,%])(?:,\s*|\s+in\s+|\s+|(?=%))(\S{1,12})")


@dataclass(frozen=True)
class Heading:
    """The headings of a grid.

    Attributes
    ----------
    columns : tuple of Column
    row : int or None
        Index into the grid's rows of the headings; None when the file has none.
    first : int
        Index into the grid's rows of the first data row.
    """

    columns: tuple[Column, ...]
    row: int | None
    first: int


def find_heading(
    grid: Grid, wanted: Collection[str] = (), known: Collection[str] = (), *, notes_below: bool = False
) -> Heading:
    """Find the headings, whatever metadata stands above and units stand below them.

    The heading row is the one that names the wanted columns or, by the usual names, at least two
    quantities; failing that, one that does so with "Strain" or "Stress", which may be true or engineering; failing
    that, the row of text above the first row of numbers, or the row above it where
    that one holds units. A row of text between headings and numbers that holds any unit is a row of
    units, whatever its other cells say.

    Parameters
    ----------
    wanted : collection of str
        Labels that the user named.
    known : collection of str
        Names of quantities beside the usual ones, as `normalised`.
    notes_below : bool
        Whether rows of text may stand between the headings and the numbers.
    """
    rows = grid.rows[:_SEARCHED_ROWS]
    header = _row_naming(rows, wanted, known)
    if header is None:
        header = _row_naming(rows, (), QUANTITY_NAMES)
    if header is None:
        first = _first_data_row(rows, 0)
        header = first - 1
        for units_at in range(header, 0, -1) if notes_below else (header,):
            if units_at > 0 and _names_units_of(rows[units_at - 1], rows[units_at]):
                header = units_at - 1
                break
        if header < 0 or not any(cell.strip() for cell in rows[header]):
            return Heading(columns=_numbered(len(rows[0])), row=None, first=first)
    units = next((at for at in range(header + 1, _first_data_row(rows, header + 1)) if _is_units_row(rows[at])), None)
    first = header + 1 if units is None else units + 1
    if notes_below:
        first = _first_data_row(rows, first)
    while first < len(rows) and not any(cell.strip() for cell in rows[first]):
        first += 1
    columns = _columns(rows[header], [] if units is None else rows[units])
    return Heading(columns=columns, row=header, first=first)


def _row_naming(rows: Sequence[Sequence[str]], wanted: Collection[str], known: Collection[str]) -> int | None:
    for at, row in enumerate(rows):
        if is_data_row(row):
            continue
        labels = {_one_line(cell) for cell in row}
        columns = _columns(row, [])
        named = sum(label in labels or any(label == c.name for c in columns) for label in wanted)
        usual = {role_of(column.name) for column in columns} - {None}
        beside = {normalised(column.name) for column in columns} & set(known)
        if named >= min(2, len(wanted)) > 0 or len(usual) >= 2 or len(beside) >= 2:
            return at
    return None


def is_data_row(row: Sequence[str]) -> bool:
    """More than half of the filled cells are samples, at least two are, and the first is no name of a fact."""
    filled = [cell.strip() for cell in row if cell.strip()]
    count = sum(map(is_sample, filled))
    return count >= 2 and count > len(filled) / 2 and not filled[0].endswith(":")


def _first_data_row(rows: Sequence[Sequence[str]], start: int) -> int:
    """Index of the first row of numbers from `start` on; the number of rows where there is none."""
    return next((at for at in range(start, len(rows)) if is_data_row(rows[at])), len(rows))


def _is_units_row(row: Sequence[str]) -> bool:
    """At least one cell is a unit, and none is a number or the name of a quantity; 1 is the unit of a strain."""
    filled = [cell.strip() for cell in row if cell.strip()]
    if any(cell != "1" and (is_number(cell) or role_of(cell) is not None) for cell in filled):
        return False
    return any(map(_is_laboratory_unit, filled))


def _names_units_of(names: Sequence[str], units: Sequence[str]) -> bool:
    """The second row is one of units, and the first has a name, no number, above each of them."""
    if not _is_units_row(units) or any(map(is_number, names)):
        return False
    named = {at for at, cell in enumerate(names) if cell.strip()}
    return all(at in named for at, cell in enumerate(units) if _is_laboratory_unit(cell))


def _is_laboratory_unit(cell: str) -> bool:
    """The cell is a unit that a heading cannot be mistaken for: not "strain", "cycle" or "t"."""
    text = without_brackets(cell)
    return is_percent(text) or any(measures(text, unit) for unit in _LABORATORY_UNITS)


def _columns(row: Sequence[str], units_row: Sequence[str]) -> tuple[Column, ...]:
    columns = []
    for position, cell in enumerate(row):
        label = _one_line(cell)
        name, unit = split_unit(label)
        if position < len(units_row) and units_row[position].strip():
            unit = without_brackets(units_row[position])
        columns.append(Column(label=label, name=name, unit=unit, position=position))
    return tuple(columns)


def split_unit(label: str) -> tuple[str, str | None]:
    """Split a heading into its name and its unit.

    >>> [split_unit(label) for label in ("Stress [kPa]", "time_s", "Kraft / N", "True strain %", "Strain")]
    [('Stress', 'kPa'), ('time', 's'), ('Kraft', 'N'), ('True strain', '%'), ('Strain', None)]
    """
    if (match := _BRACKETED.fullmatch(label)) and match[1]:
        return match[1], match[2].strip() or None
    if (match := _SLASHED.fullmatch(label)) and is_unit(match[2]):
        return match[1], match[2]
    if (match := _TRAILING.fullmatch(label)) and role_of(match[1]) is not None and is_unit(match[2]):
        return match[1], match[2]
    if role_of(label) is None and (split := split_suffix(normalised(label))) is not None:
        return split
    return label, None


def _numbered(width: int) -> tuple[Column, ...]:
    """Columns of a file without headings, called by their position."""
    return tuple(Column(label=f"{at + 1}", name=f"{at + 1}", unit=None, position=at) for at in range(width))


def without_brackets(text: str) -> str:
    """Strip the brackets that may stand around a unit: "(kN)" becomes "kN"."""
    match = _BRACKETED_ALONE.fullmatch(text.strip())
    return match[1].strip() if match else text.strip()


def _one_line(cell: str) -> str:
    return " ".join(cell.split())
