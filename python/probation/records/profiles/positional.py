"""Side-by-side specimens whose columns are known by position, whatever the headings say."""

from collections.abc import Sequence

from probation._complaint import bad_input
from probation.records.cell import decimal_mark
from probation.records.grid import Grid
from probation.records.source import Source
from probation.records.table import Column, Table


def tables_by_position(
    source: Source,
    grid: Grid,
    block: Sequence[tuple[str, str | None]],
    roles: dict[str, str],
    header_rows: int,
) -> tuple[Table, ...]:
    """Cut a grid into one table per block of columns.

    Parameters
    ----------
    source : Source
    grid : Grid
    block : sequence of (name, unit)
        The columns of one specimen, from left to right.
    roles : dict of str to str
        Which of the names plays which role.
    header_rows : int
        Rows to skip at the top.

    Raises
    ------
    InputError
        If the width is no multiple of the block's, or there are no data rows.
    """
    if len(grid.rows) <= header_rows:
        raise bad_input(source.path, "no row of numbers", "at least ten")
    width = max(len(row) for row in grid.rows[: header_rows + 1])
    if width == 0 or width % len(block):
        raise bad_input(
            source.path,
            f"{width} columns",
            f"a multiple of {len(block)} ({len(block)} for each specimen)",
            row=grid.row_numbers[0],
            remedy="name another profile",
        )
    rows = grid.rows[header_rows:]
    decimal = decimal_mark(rows)
    return tuple(
        Table(
            path=source.path,
            columns=tuple(
                Column(label=name, name=name, unit=unit, position=start + at) for at, (name, unit) in enumerate(block)
            ),
            rows=rows,
            row_numbers=grid.row_numbers[header_rows:],
            header_row=grid.row_numbers[header_rows - 1] if header_rows else None,
            decimal=decimal,
            roles=roles,
        )
        for start in range(0, width, len(block))
    )
