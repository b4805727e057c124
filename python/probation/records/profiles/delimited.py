"""Profile ``csv``: comma, semicolon or tab between the cells, headings found wherever they stand."""

from probation._complaint import bad_input
from probation.records.grid import Grid, decimal_mark, read_grid
from probation.records.header import find_heading
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.source import Source
from probation.records.table import Table


def read(source: Source, options: ReadOptions) -> Reading:
    """Read any delimited text."""
    grid = read_grid(source)
    return Reading(tables=(table_from(source, grid, options),), separator=grid.separator)


def table_from(source: Source, grid: Grid, options: ReadOptions) -> Table:
    """Find headings and data in a grid of cells.

    Raises
    ------
    InputError
        If there are no data rows, or a row is wider than the headings.
    """
    heading = find_heading(grid, options.labels)
    rows, row_numbers = grid.rows[heading.first :], grid.row_numbers[heading.first :]
    if not rows:
        raise bad_input(
            source.path,
            "no row of numbers",
            "at least ten rows of numbers below the headings",
            row=grid.row_numbers[-1],
            remedy="export the samples too",
        )
    width = len(heading.columns)
    for row, number in zip(rows, row_numbers, strict=True):
        if len(row) > width and any(cell.strip() for cell in row[width:]):
            raise bad_input(
                source.path,
                f"{len(row)} cells",
                f"{width}, as many as columns",
                row=number,
                remedy="decimal commas need another separator than the comma, or quotes around each number",
            )
    return Table(
        path=source.path,
        columns=heading.columns,
        rows=rows,
        row_numbers=row_numbers,
        header_row=None if heading.row is None else grid.row_numbers[heading.row],
        decimal=decimal_mark(rows),
    )


PROFILE = Profile(
    name="csv",
    title="delimited text with headings",
    recognises=lambda source: True,  # the last resort
    read=read,
)
