"""The tables of a grid of cells: one for each specimen, side by side or one below the other."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

from probation._complaint import bad_input, quoted
from probation.errors import InputError
from probation.records.assignment import implied_columns
from probation.records.cell import decimal_mark, is_sample
from probation.records.grid import Grid
from probation.records.header import Heading, find_heading, is_data_row
from probation.records.header_block import header_block
from probation.records.options import ReadOptions
from probation.records.profiles.machines import machine_of
from probation.records.profiles.profile import Reading
from probation.records.roles import normalised
from probation.records.source import Source
from probation.records.table import Column, Table

_REMARK = ("#", "//")


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
    blocks = _blocks(grid, heading)
    tables = _tables(source, grid, heading, blocks)
    if machine is not None:
        tables = tuple(table.with_roles(machine.roles(table.columns)) for table in tables)
    above = header_block(source.path, grid.rows[: 0 if heading.row is None else heading.row])
    between = [header_block(source.path, grid.rows[block.end : after.heading]) for block, after in pairwise(blocks)]
    width = len(tables) // len(blocks)
    own = [above.specimen(0) if between else {}, *(block.specimen(0) for block in between)]
    tables = tuple(
        replace(table, specimen=above.specimen(number) | (own[number // width] if len(above.specimens) < 2 else {}))
        for number, table in enumerate(tables)
    )
    joined = _continued(tables)
    continued = (f"{len(tables)} tables joined to {len(joined)}: the time goes on from one to the next",)
    return Reading(
        tables=joined,
        separator=grid.separator,
        metadata=above.facts,
        warnings=(*_notes(grid, blocks, tables), *(continued if len(joined) < len(tables) else ())),
        machine="" if machine is None else machine.name,
    )


def table_from(source: Source, grid: Grid, options: ReadOptions) -> Table:
    """The table of a grid that holds one specimen under the usual headings.

    Raises
    ------
    InputError
        As `read_tables`.
    """
    heading = find_heading(grid, options.labels)
    return _tables(source, grid, heading, _blocks(grid, heading))[0]


def _tables(source: Source, grid: Grid, heading: Heading, blocks: Sequence["_Block"]) -> tuple[Table, ...]:
    if heading.first >= len(grid.rows):
        raise bad_input(
            source.path,
            "no row of numbers",
            "at least ten rows of numbers below the headings",
            row=grid.row_numbers[-1],
            remedy="export the samples too",
        )
    tables = []
    for block in blocks:
        samples = [at for at in range(block.first, block.end) if not _is_remark(grid.rows[at])]
        rows, row_numbers = [grid.rows[at] for at in samples], [grid.row_numbers[at] for at in samples]
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


@dataclass(frozen=True)
class _Block:
    """Rows of a grid: those of a heading, of the first numbers, and the one after the last numbers."""

    heading: int
    first: int
    end: int


def _blocks(grid: Grid, heading: Heading) -> list[_Block]:
    """The rows of each table, where the row of the headings comes again below the numbers; text below is cut.

    A table of results may stand below, too: from a row of text on, no row begins with a number.
    """
    starts = [-1 if heading.row is None else heading.row]
    if heading.row is not None:
        cells = _stripped(grid.rows[heading.row])
        starts += [at for at in range(heading.first, len(grid.rows)) if _stripped(grid.rows[at]) == cells]
    blocks = []
    for start, below in pairwise([*starts, len(grid.rows)]):
        first = start + heading.first - starts[0]
        end = below
        while below < len(grid.rows) and end > first and not is_data_row(grid.rows[end - 1]):
            end -= 1  # above the next headings stands what names their specimen: "2,PP-02"
        last = _end_of_numbers(grid.rows, first, end)
        if last > first:
            blocks.append(_Block(start, first, last))
    return blocks or [_Block(starts[0], heading.first, len(grid.rows))]


def _end_of_numbers(rows: Sequence[Sequence[str]], first: int, end: int) -> int:
    """The row after the last one of numbers; where rows begin with a sample, one that does not is none below text."""
    last = end
    if first < end and _begins_with_sample(rows[first]):
        while not _begins_with_sample(rows[last - 1]):
            last -= 1
        return next((at for at in range(last, end) if _is_text(rows[at])), end)
    while last > first and _is_text(rows[last - 1]):
        last -= 1
    return last


def _is_text(row: Sequence[str]) -> bool:
    """The row begins with text, and not most of its cells are numbers: a fact, a remark, a name."""
    filled = [cell for cell in row if cell.strip()]
    return not filled or (not is_sample(filled[0]) and 2 * sum(map(is_sample, filled)) <= len(filled))


def _is_remark(row: Sequence[str]) -> bool:
    return next((cell for cell in row if cell.strip()), "").lstrip().startswith(_REMARK)


def _begins_with_sample(row: Sequence[str]) -> bool:
    first = next((cell for cell in row if cell.strip()), "")
    return is_sample(first)


def _continued(tables: Sequence[Table]) -> tuple[Table, ...]:
    """The tables, those joined that go on where the one above ends: the time is that of one test."""
    joined: list[Table] = []
    for table in tables:
        before = joined[-1] if joined else None
        if before is not None and before.columns == table.columns and _goes_on(before, table):
            rows, row_numbers = [*before.rows, *table.rows], [*before.row_numbers, *table.row_numbers]
            joined[-1] = replace(before, rows=rows, row_numbers=row_numbers)
        else:
            joined.append(table)
    return tuple(joined)


def _goes_on(before: Table, table: Table) -> bool:
    """Whether the time of a table begins after that of the one above, but not by more than that lasted."""
    try:
        column = implied_columns(table, [("time",)]).get("time")
        if column is None:
            return False
        ends = [(float(times[0]), float(times[-1])) for times in (before.times(column), table.times(column))]
    except InputError:
        return False  # what is wrong is said when the columns are read
    (start, end), (goes_on, _) = ends
    return end < goes_on < 2.0 * end - start


def _notes(grid: Grid, blocks: Sequence[_Block], tables: Sequence[Table]) -> tuple[str, ...]:
    """What is left out below the last numbers, and which headings stand several times."""
    notes = []
    below = [at for at in range(blocks[-1].end, len(grid.rows)) if any(map(str.strip, grid.rows[at]))]
    if below:
        text = quoted(next(cell for cell in _stripped(grid.rows[below[0]]) if cell))
        plural = "row" if len(below) == 1 else "rows"
        notes.append(
            f"left out {len(below)} {plural} of text below the numbers: {text} in row {grid.row_numbers[below[0]]}"
        )
    remarks = [at for block in blocks for at in range(block.first, block.end) if _is_remark(grid.rows[at])]
    if remarks:
        text = quoted(" ".join(_stripped(grid.rows[remarks[0]])).strip())
        notes.append(
            f"left out {len(remarks)} remark{'s' * (len(remarks) > 1)} between the numbers: {text} in row "
            f"{grid.row_numbers[remarks[0]]}"
        )
    columns = tables[0].columns
    for role, place in tables[0].roles.items():
        column = next((column for column in columns if column.position + 1 == place), None)
        if column is not None and sum(other.label == column.label for other in columns) > 1:
            notes.append(
                f"several columns are headed {quoted(column.label)}: the first, position {place}, is read; "
                f"columns = {{ {role} = … }} (--column {role}=…) takes another by position"
            )
    return tuple(notes)


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
