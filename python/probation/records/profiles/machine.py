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
"""First rows by which the software of a machine is recognised."""
_DECIDED_BY_UNIT = {"engineering_strain": ("mm", "displacement"), "force": ("MPa", "engineering_stress")}


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
        Position of the column for each role, counted from 1, of a table's columns.
    headings : frozenset of str
        What it calls its quantities, as `normalised`; they tell the row of the headings.
    notes_below : bool
        Whether rows of text stand between the headings and the numbers.
    """

    name: str
    title: str
    recognises: Callable[[str], bool]
    roles: Callable[[Sequence[Column]], dict[str, int]]
    headings: frozenset[str]
    notes_below: bool = False


def machine_by_headings(
    name: str, title: str, recognises: Callable[[str], bool], headings: Mapping[str, Sequence[str]]
) -> Machine:
    """A machine whose headings tell the roles.

    Parameters
    ----------
    headings : mapping of str to sequence of str
        What it calls the quantity of each role, as `normalised`, best first; of several columns of one
        heading the first. The unit decides where it contradicts the heading: a strain in mm is a displacement, a
        force in MPa an engineering stress.
    """

    def roles(columns: Sequence[Column]) -> dict[str, int]:
        assigned: dict[str, int] = {}
        for role, names in headings.items():
            for heading in names:
                column = next((one for one in columns if normalised(one.name) == heading), None)
                if column is not None:
                    unit, other = _DECIDED_BY_UNIT.get(role, ("", role))
                    contradicted = bool(unit) and measures(column.unit or "", unit)
                    assigned.setdefault(other if contradicted else role, column.position + 1)
                    break
        return assigned

    known = frozenset(heading for names in headings.values() for heading in names)
    return Machine(name, title, recognises, roles, known)


def head(grid: Grid) -> str:
    """The first rows as text, cells joined by tabs: what machines are recognised by."""
    return "\n".join("\t".join(cell.strip() for cell in row) for row in grid.rows[:_RECOGNISED_ROWS])
