"""What a testing machine's or an acquisition program's own files have in common, in text and in workbooks.

A machine knows its headings: which column is which, best first, and that its "strain" is engineering strain.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from probation.records.grid import Grid
from probation.records.roles import normalised
from probation.records.table import Column
from probation.records.units import measures

_RECOGNISED_ROWS = 60


@dataclass(frozen=True)
class Machine:
    """A kind of machine or program that writes tables.

    Attributes
    ----------
    name, title : str
        As in ``profile = "…"``, and what it is.
    recognises : callable
        Whether the first rows, their cells joined by tabs, are of this kind.
    roles : callable
        Label of the column for each role, of a table's columns.
    headings : frozenset of str
        What it calls its quantities, as `normalised`; they tell the row of the headings.
    notes_below : bool
        Whether rows of text stand between the headings and the numbers.
    """

    name: str
    title: str
    recognises: Callable[[str], bool]
    roles: Callable[[Sequence[Column]], dict[str, str]]
    headings: frozenset[str]
    notes_below: bool = False


def machine_by_headings(
    name: str, title: str, recognises: Callable[[str], bool], headings: Mapping[str, Sequence[str]]
) -> Machine:
    """A machine whose headings tell the roles.

    Parameters
    ----------
    headings : mapping of str to sequence of str
        What it calls the quantity of each role, as `normalised`, best first. A strain in a unit of length is
        a displacement.
    """

    def roles(columns: Sequence[Column]) -> dict[str, str]:
        assigned: dict[str, str] = {}
        for role, names in headings.items():
            for heading in names:
                column = next((one for one in columns if normalised(one.name) == heading), None)
                if column is not None:
                    is_length = role == "engineering_strain" and measures(column.unit or "", "mm")
                    assigned.setdefault("displacement" if is_length else role, column.label)
                    break
        return assigned

    known = frozenset(heading for names in headings.values() for heading in names)
    return Machine(name, title, recognises, roles, known)


def head(grid: Grid) -> str:
    """The first rows as text, cells joined by tabs: what machines are recognised by."""
    return "\n".join("\t".join(cell.strip() for cell in row) for row in grid.rows[:_RECOGNISED_ROWS])
