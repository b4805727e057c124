"""A specimen's named columns, as the file holds them: text until someone asks for numbers."""

import re
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from probation._complaint import bad_input, quoted
from probation.records.cell import seconds_of_day, with_point

FloatArray = NDArray[np.float64]
_HALF_A_DAY = 43200.0  # s; a step back by more is midnight


@dataclass(frozen=True)
class Column:
    """One column of a file.

    Attributes
    ----------
    label : str
        The heading as the file has it.
    name : str
        The heading without its unit.
    unit : str or None
        The unit as the file spells it; None when it gives none.
    position : int
        Counted from 0 at the left edge of the file.
    """

    label: str
    name: str
    unit: str | None
    position: int


@dataclass(frozen=True)
class Table:
    """The columns of one specimen.

    Attributes
    ----------
    path : Path
    columns : tuple of Column
    rows : list of list of str
        The data cells of the whole file, shared by specimens that stand side by side.
    row_numbers : list of int
        The file's row of each, counted from 1.
    header_row : int or None
        The file's row of the headings.
    decimal : str
        ``"."`` or ``","``.
    roles : dict of str to str or int
        Label, or position counted from 1, of the column that plays each role (``{"time": "Time (s)"}``) where the
        import profile knows; otherwise empty, and the headings decide.
    specimen : dict of str to float
        ``area_mm2`` and ``gauge_length_mm`` that the file states for this specimen.
    """

    path: Path
    columns: tuple[Column, ...]
    rows: list[list[str]]
    row_numbers: list[int]
    header_row: int | None
    decimal: str = "."
    roles: Mapping[str, str | int] = field(default_factory=dict)
    specimen: dict[str, float] = field(default_factory=dict)

    @property
    def headed(self) -> bool:
        """Whether its columns have headings of their own."""
        return self.header_row is not None

    def with_roles(self, roles: Mapping[str, str | int]) -> "Table":
        """Copy the table, with what its profile knows of the columns."""
        return replace(self, roles=roles)

    def cells(self, column: Column) -> list[str]:
        """Text of a column, empty where a row ends before it."""
        at = column.position
        return [row[at] if at < len(row) else "" for row in self.rows]

    def numbers(self, column: Column) -> FloatArray:
        """Values of a column.

        Returns
        -------
        ndarray, shape (n_rows,) [the file's unit]
            NaN where the cell is empty.

        Raises
        ------
        InputError
            At the first cell that is no number.
        """
        cells = self.cells(column)
        texts = [cell.replace(",", ".") for cell in cells] if self.decimal == "," else cells
        try:
            values = np.array([float(text) if text else np.nan for text in texts], dtype=np.float64)
        except ValueError:
            pass
        else:
            if not any("_" in text for text in texts):  # float() reads 1_000, no laboratory writes it
                return values
        return self._cell_by_cell(column, cells)

    def times(self, column: Column) -> FloatArray:
        """Values of a column of times, those of day in seconds since the first.

        Raises
        ------
        InputError
            As `numbers`.
        """
        of_day = self.clock_times(column)
        return self.numbers(column) if of_day is None else of_day

    def clock_times(self, column: Column) -> FloatArray | None:
        """Seconds since the first sample, where the column holds times of day; None where it does not.

        A time that is earlier than the one above is one of the next day.

        Returns
        -------
        ndarray, shape (n_rows,) [s] or None
            NaN where the cell is empty.

        Raises
        ------
        InputError
            If the first sample has a time of day and another has none.
        """
        cells = self.cells(column)
        filled = [at for at, cell in enumerate(cells) if cell.strip()]
        if not filled or seconds_of_day(cells[filled[0]]) is None:
            return None
        times = [seconds_of_day(cells[at]) for at in filled]
        if None in times:
            at = filled[times.index(None)]
            raise bad_input(
                self.path,
                quoted(cells[at]),
                f"a time of day as in row {self.row_numbers[filled[0]]}, {quoted(cells[filled[0]])}",
                row=self.row_numbers[at],
                column=column.label,
                remedy=self._remedy(cells[at].strip()),
            )
        of_day = np.array(times, dtype=np.float64)
        days = np.cumsum(np.diff(of_day, prepend=of_day[0]) < -_HALF_A_DAY)
        values = np.full(len(cells), np.nan)
        values[filled] = of_day - of_day[0] + 2.0 * _HALF_A_DAY * days
        return values

    def _cell_by_cell(self, column: Column, cells: list[str]) -> FloatArray:
        """Parse slowly: tolerate blanks, and name the first cell that is no number."""
        values = np.full(len(cells), np.nan)
        for at, cell in enumerate(cells):
            text = cell.strip()
            try:
                if "_" in text:
                    raise ValueError
                if text:
                    values[at] = float(with_point(text, self.decimal))
            except ValueError:
                raise bad_input(
                    self.path,
                    quoted(cell),
                    "a number",
                    row=self.row_numbers[at],
                    column=column.label,
                    remedy=self._remedy(text),
                ) from None
        return values

    def _remedy(self, text: str) -> str:
        if "\n" in text or '"' in text:
            return "close the quote, or remove it"
        if re.fullmatch(r"[+-]?\d+,\d+", text) and self.decimal == ".":
            return "other cells use the decimal point: use one decimal mark throughout"
        if re.fullmatch(r"[+-]?[\d.,' ]+", text):
            return "remove thousands separators"
        if re.fullmatch(r"[+-]?[\d.,]+(e[+-]?\d+)?\s*\D+", text, re.IGNORECASE):
            return "put the unit into the heading instead"
        return "correct or remove the cell"
