"""The tables of a grid of cells: one for each specimen, side by side or one below the other."""

from collections.abc import Sequence
from dataclasses import replace
from itertools import pairwise

from probation._complaint import bad_input
from probation.records.grid import Grid, decimal_mark, is_number
from probation.records.header import Heading, find_heading
from probation.records.header_block import header_block
from probation.records.options import ReadOptions
from probation.records.profiles.machines import machine_of
from probation.records.profiles.profile import Reading
from probation.records.roles import normalised
from probation.records.source import Source
from probation.records.table import Column, Table


def read_tables(source: Source, grid: Grid, options: ReadOptions) -> Reading:
    """Read a grid: headings, the specimens below them, and what is stated above them.

    The headings are a machine's where one is named in `options` or recognised; otherwise the usual ones.

    Raises
    ------
    InputError
        If there are no data rows, or a row is wider than the headings.
    """
    machine = machine_of(grid, options.profile)
    if machine is None and options.profile is None:
        machine = machine_of(grid)
    if machine is None:
        heading = find_heading(grid, options.labels)
    else:
        heading = find_heading(grid, options.labels, machine.headings, notes_below=machine.notes_below)
    tables = _tables(source, grid, heading)
    if machine is not None:
        tables = tuple(table.with_roles(machine.roles(table.columns)) for table in tables)
    above = header_block(source.path, grid, 0 if heading.row is None else heading.row)
    return Reading(
        tables=tuple(replace(table, specimen=above.specimen(number)) for number, table in enumerate(tables)),
        separator=grid.separator,
        metadata=above.facts,
        machine="" if machine is None else machine.name,
    )


def table_from(source: Source, grid: Grid, options: ReadOptions) -> Table:
    """The table of a grid that holds one specimen under the usual headings.

    Raises
    ------
    InputError
        As `read_tables`.
    """
    return _tables(source, grid, find_heading(grid, options.labels))[0]


def _tables(source: Source, grid: Grid, heading: Heading) -> tuple[Table, ...]:
    if heading.first >= len(grid.rows):
        raise bad_input(
            source.path,
            "no row of numbers",
            "at least ten rows of numbers below the headings",
            row=grid.row_numbers[-1],
            remedy="export the samples too",
        )
    tables = []
    for start, end in _stacked(grid, heading):
        rows, row_numbers = grid.rows[start:end], grid.row_numbers[start:end]
        _check_width(source, rows, row_numbers, len(heading.columns))
        decimal = decimal_mark(rows)
        tables += [
            Table(
                path=source.path,
                columns=columns,
                rows=rows,
                row_numbers=row_numbers,
                header_row=None if heading.row is None else grid.row_numbers[heading.row],
                decimal=decimal,
            )
            for columns in side_by_side(heading.columns)
        ]
    return tuple(tables)


def side_by_side(columns: Sequence[Column]) -> list[tuple[Column, ...]]:
    """Split columns into those of each specimen, where the same headings stand there several times in a row."""
    names = [normalised(column.name) for column in columns]
    starts = [at for at, name in enumerate(names) if name and name == names[0]]
    blocks = [tuple(columns[start:end]) for start, end in pairwise([*starts, len(columns)])]
    filled = [tuple(column for column in block if column.name) for block in blocks]
    headed = [[normalised(column.name) for column in block] for block in filled]
    if len(blocks) > 1 and len(headed[0]) > 1 and all(block == headed[0] for block in headed):
        return filled
    return [tuple(columns)]


def _stacked(grid: Grid, heading: Heading) -> list[tuple[int, int]]:
    """First and last data rows of each table, where the row of the headings comes again below the numbers."""
    if heading.row is None:
        return [(heading.first, len(grid.rows))]
    cells = _stripped(grid.rows[heading.row])
    starts = [at for at in range(heading.first, len(grid.rows)) if _stripped(grid.rows[at]) == cells]
    tables = []
    for start, end in pairwise([heading.row, *starts, len(grid.rows)]):
        first = start + heading.first - heading.row
        last = end
        while end < len(grid.rows) and last > first and not any(map(is_number, grid.rows[last - 1])):
            last -= 1  # the name of the specimen that follows
        if last > first:
            tables.append((first, last))
    return tables


def _stripped(row: Sequence[str]) -> list[str]:
    return [cell.strip() for cell in row]


def _check_width(source: Source, rows: Sequence[Sequence[str]], row_numbers: Sequence[int], width: int) -> None:
    for row, number in zip(rows, row_numbers, strict=True):
        if len(row) > width and any(cell.strip() for cell in row[width:]):
            raise bad_input(
                source.path,
                f"{len(row)} cells",
                f"{width}, as many as columns",
                row=number,
                remedy="decimal commas need another separator than the comma, or quotes around each number",
            )
