"""What goes wrong with the cells, headings, units and rows of a table: one function each, and a line in `MUTATIONS`."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

from fuzz import odd

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from fuzz.rows import Rows

Cells = list[list[str]]


@dataclass(frozen=True)
class _Place:
    """Where something goes wrong.

    Attributes
    ----------
    cells : list of list of str
        Of the whole table; changed in place.
    first : int
        Index of the first row of numbers.
    heading : int or None
        Index of the row of headings.
    row, column : int
        A filled cell below the headings.
    chance : Random
    """

    cells: Cells
    first: int
    heading: int | None
    row: int
    column: int
    chance: Random

    @property
    def here(self) -> list[str]:
        """The row."""
        return self.cells[self.row]

    def change(self, new: Callable[[str], str]) -> None:
        """Change every number of the column."""
        for row in self.cells[self.first :]:
            if self.column < len(row):
                row[self.column] = new(row[self.column])


def mutated(rows: Rows, chance: Random) -> Rows:
    """One thing that goes wrong with cells, headings, units or rows."""
    cells = [list(row) for row in rows.cells]
    filled = [at for at in range(min(rows.first, len(cells) - 1), len(cells)) if cells[at]]
    if not filled:
        return replace(rows, cells=[["1", "2", "3"]], first=0, heading=None)
    row = chance.choice(filled)
    heading = rows.heading if rows.heading is not None and rows.heading < len(cells) and cells[rows.heading] else None
    place = _Place(cells, rows.first, heading, row, chance.randrange(len(cells[row])), chance)
    mutation = chance.choice([each for each, weight in MUTATIONS.items() for _ in range(weight)])
    mutation(place)
    return replace(rows, cells=cells or [[""]])


def _cell(place: _Place) -> None:
    place.here[place.column] = place.chance.choice(odd.CELLS)


def _cell_of_the_first_row(place: _Place) -> None:
    first = place.cells[min(place.first, len(place.cells) - 1)]
    first[:] = [place.chance.choice(odd.CELLS) if at == place.column else cell for at, cell in enumerate(first)]


def _column_of_one_value(place: _Place) -> None:
    value = place.chance.choice((*odd.NUMBERS[:12], "0", "1", "5"))
    place.change(lambda _: value)


def _column_scaled(place: _Place) -> None:
    factor = place.chance.choice((0.0, -1.0, 1e-300, 1e-30, 1e-6, 1e3, 1e6, 1e30, 1e300))
    place.change(lambda text: _scaled(text, factor))


def _column_shifted(place: _Place) -> None:
    shift = place.chance.choice((-1e3, -1.0, 1.0, 8.0, 1e6, 1e15))
    place.change(lambda text: _scaled(text, 1.0, shift))


def _heading(place: _Place) -> None:
    names = place.cells[place.heading or 0] or place.here
    names[place.chance.randrange(len(names))] = place.chance.choice(odd.HEADINGS)


def _unit_of_a_heading(place: _Place) -> None:
    names = place.cells[place.heading or 0] or place.here
    at = place.chance.randrange(len(names))
    form = place.chance.choice(("{} [{}]", "{} ({})", "{} / {}", "{}_{}", "{}, {}", "{} in {}", "{} {}"))
    name = names[at].split("[")[0].split("(")[0].split("/")[0].strip()
    names[at] = form.format(name, place.chance.choice(odd.UNITS))


def _units_row(place: _Place) -> None:
    at = place.first if place.heading is None else place.heading + place.chance.choice((0, 1, 1, 1))
    usual = ("s", "mm", "kN", "MPa", "%", "-", "Sec", "segments") * (place.chance.random() < 0.7) or odd.UNITS
    units = [place.chance.choice((*usual, place.chance.choice(odd.UNITS))) for _ in place.here]
    place.cells.insert(at, units)


def _row_again(place: _Place) -> None:
    place.cells.insert(place.row, list(place.here))


def _rows_again(place: _Place) -> None:
    place.cells.extend([list(row) for row in place.cells[place.first :]])


def _row_lost(place: _Place) -> None:
    del place.cells[place.row]


def _headings_lost(place: _Place) -> None:
    del place.cells[place.heading or 0]


def _headings_again(place: _Place) -> None:
    place.cells.insert(place.row, list(place.cells[place.heading or 0]))


def _reversed(place: _Place) -> None:
    place.cells[place.first :] = place.cells[place.first :][::-1]


def _shuffled(place: _Place) -> None:
    rows = place.cells[place.first :]
    place.chance.shuffle(rows)
    place.cells[place.first :] = rows


def _cut(place: _Place) -> None:
    del place.cells[place.row :]


def _cut_at_the_start(place: _Place) -> None:
    del place.cells[place.first : place.row]


def _wider(place: _Place) -> None:
    place.here.extend([place.chance.choice(odd.CELLS)] * place.chance.choice((1, 2, 50)))


def _narrower(place: _Place) -> None:
    del place.here[place.column :]


def _blank_rows(place: _Place) -> None:
    blank = place.chance.choice(([], [""] * len(place.here), [" "]))
    place.cells[place.row : place.row] = [list(blank) for _ in range(place.chance.choice((1, 3, 30)))]


def _columns_swapped(place: _Place) -> None:
    other = place.chance.randrange(len(place.here))
    for row in place.cells:
        if max(place.column, other) < len(row):
            row[place.column], row[other] = row[other], row[place.column]


def _column_lost(place: _Place) -> None:
    for row in place.cells:
        del row[place.column : place.column + 1]


def _column_again(place: _Place) -> None:
    for row in place.cells:
        row.extend(row[place.column : place.column + 1])


def _decimal_comma(place: _Place) -> None:
    place.here[place.column] = place.here[place.column].replace(".", ",")


def _decimal_commas(place: _Place) -> None:
    place.change(lambda text: text.replace(".", ","))


def _unit_in_a_cell(place: _Place) -> None:
    place.here[place.column] += place.chance.choice((" s", " MPa", "%", "kN", "mm"))


MUTATIONS: dict[Callable[[_Place], None], int] = {
    _cell: 4,
    _cell_of_the_first_row: 1,
    _column_of_one_value: 2,
    _column_scaled: 2,
    _column_shifted: 1,
    _heading: 2,
    _unit_of_a_heading: 2,
    _units_row: 2,
    _row_again: 1,
    _rows_again: 1,
    _row_lost: 1,
    _headings_lost: 1,
    _headings_again: 1,
    _reversed: 1,
    _shuffled: 1,
    _cut: 1,
    _cut_at_the_start: 1,
    _wider: 1,
    _narrower: 1,
    _blank_rows: 1,
    _columns_swapped: 1,
    _column_lost: 1,
    _column_again: 1,
    _decimal_comma: 1,
    _decimal_commas: 1,
    _unit_in_a_cell: 1,
}
"""Each with its weight."""


def _scaled(text: str, factor: float, shift: float = 0.0) -> str:
    try:
        return f"{float(text) * factor + shift:.9g}"
    except ValueError:
        return text
