"""Profile ``excel``: an .xlsx workbook; the first sheet with enough rows, or the one named."""

import io
import re
import warnings
import zipfile
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from decimal import Decimal
from typing import TYPE_CHECKING

from probation._complaint import bad_input, quoted, suggestion
from probation.errors import InputError
from probation.limits import INFLATED_BYTES, MEBIBYTE
from probation.records.grid import Grid, check_extent
from probation.records.header_block import header_block
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.profiles.tables import read_tables
from probation.records.source import Source
from probation.records.table import Table
from probation.records.units import is_percent
from probation.settings.reading import READING

if TYPE_CHECKING:
    from openpyxl.cell.cell import Cell, MergedCell
    from openpyxl.workbook import Workbook

_HEADED_ROWS = 60
"""First rows of every sheet that are searched for headings like those of the table, and for dimensions of specimens."""
_ZIP_MAGIC = b"PK\x03\x04"
_PLAIN_TEXT = re.compile(r'"[^"]*"|\\.')  # of a number format: text that is shown beside the number
_OLD_EXCEL_MAGIC = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"


def recognises(source: Source) -> bool:
    """Know a zip archive, or an old .xls, which is at least refused by its name."""
    return source.data.startswith((_ZIP_MAGIC, _OLD_EXCEL_MAGIC))


def read(source: Source, options: ReadOptions) -> Reading:
    """Read one sheet as a table of cells."""
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # openpyxl warns of styles, validations and dates, never of numbers
            return _read(source, options)
    except InputError:
        raise
    except Exception:  # openpyxl answers damaged archives and XML with a dozen unrelated exception types
        raise bad_input(
            source.path, "no Excel workbook, or a damaged one", "an .xlsx file", remedy="save it again, as .xlsx or CSV"
        ) from None


def _read(source: Source, options: ReadOptions) -> Reading:
    workbook = _open(source)
    try:
        sheets = [options.sheet] if options.sheet is not None else workbook.sheetnames
        if options.sheet is not None and options.sheet not in workbook.sheetnames:
            raise InputError(
                f"{source.path}: found no sheet {quoted(options.sheet)}; "
                + suggestion(options.sheet, workbook.sheetnames)
            )
        filled = [(name, content) for name in sheets if (content := _grid(source, workbook, name))[0].rows]
        heads = {name: _grid(source, workbook, name, _HEADED_ROWS)[0] for name in workbook.sheetnames}
    finally:
        workbook.close()
    if not filled:
        raise bad_input(source.path, "an empty sheet", "a table with headings and at least ten rows")
    long = [sheet for sheet in filled if len(sheet[1][0].rows) > READING.fewest_samples]
    name, (grid, percents) = (long or filled)[0]
    reading = read_tables(source, grid, options)
    like = tuple(other for other, head in heads.items() if _is_headed_alike(head, reading.tables[0]))
    elsewhere = _said_elsewhere(source, heads, like, name)
    ignored = [other for other, _ in filled if other != name]
    note = f"read sheet {quoted(name)} only; choose another with sheet = … (--sheet): {', '.join(ignored)}"
    return replace(
        reading,
        tables=tuple(
            replace(_as_shown(table, percents), specimen=elsewhere | table.specimen) for table in reading.tables
        ),
        warnings=(*reading.warnings, note) if ignored else reading.warnings,
        like_sheets=like if options.sheet is None else (),
    )


def _is_headed_alike(grid: Grid, table: Table) -> bool:
    """The sheet has the headings of the table, so it is another specimen of the same test."""
    headings = [column.label for column in table.columns if column.label]
    rows = ([text for cell in row if (text := " ".join(cell.split()))] for row in grid.rows)
    return any(row[: len(headings)] == headings for row in rows)


def _said_elsewhere(source: Source, heads: Mapping[str, Grid], like: Sequence[str], name: str) -> dict[str, float]:
    """Dimensions in the sheets without samples: of all specimens, or a row for each in the order of their sheets."""
    dimensions: dict[str, float] = {}
    for other, head in heads.items():
        if other == name or other in like:
            continue
        block = header_block(source.path, head.rows)
        if len(block.specimens) in (1, len(like)):
            dimensions = block.specimen(like.index(name) if name in like else 0) | dimensions
    return dimensions


def _open(source: Source) -> "Workbook":
    if source.data.startswith(_OLD_EXCEL_MAGIC):
        raise bad_input(source.path, "an old Excel file (.xls)", "an .xlsx workbook", remedy="save it as .xlsx")
    import openpyxl  # noqa: PLC0415 - a quarter of a second that text files need not wait for

    content = io.BytesIO(source.data)
    with zipfile.ZipFile(content) as archive:  # unpacking stops at the sizes that stand there
        unpacked = sum(entry.file_size for entry in archive.infolist())
    if unpacked > INFLATED_BYTES:
        limit = f"{INFLATED_BYTES // MEBIBYTE} MiB"
        raise bad_input(
            source.path, f"a workbook of more than {limit} unpacked", f"at most {limit}", remedy="save the sheet as CSV"
        )
    return openpyxl.load_workbook(content, read_only=True, data_only=True, keep_links=False)


def _grid(
    source: Source, workbook: "Workbook", name: str, last: int | None = None
) -> tuple[Grid, set[tuple[int, int]]]:
    """The cells of a sheet, to a last row; and which, by row number and position, are shown as percentages."""
    sheet = workbook[name]
    percents: set[tuple[int, int]] = set()
    rows: list[list[str]] = []
    row_numbers: list[int] = []
    count = 0
    if hasattr(sheet, "iter_rows"):  # a chart sheet has none
        if hasattr(sheet, "reset_dimensions"):
            sheet.reset_dimensions()  # some programs write a wrong extent
        for number, cells in enumerate(sheet.iter_rows(max_row=last), start=1):
            count += len(cells)
            check_extent(source, number, len(cells), count)
            percents.update((number, at) for at, cell in enumerate(cells) if _is_percentage(cell))
            if row := _texts(cell.value for cell in cells):
                rows.append(row)
                row_numbers.append(number)
    return Grid(rows=rows, row_numbers=row_numbers, separator=f"Excel sheet {quoted(name)}"), percents


def _is_percentage(cell: "Cell | MergedCell") -> bool:
    """A number shown in percent: 5 % is stored as 0.05."""
    if cell.value is None or cell.data_type != "n" or not cell.has_style:
        return False
    return "%" in _PLAIN_TEXT.sub("", cell.number_format or "")


def _as_shown(table: Table, percents: set[tuple[int, int]]) -> Table:
    """The table with every percentage as the sheet shows it, in columns of percent or of no unit.

    A unit such as mm/mm takes the stored fraction. Of a column without unit, the other numbers are made percent too.
    """
    columns, rows = list(table.columns), table.rows
    for at, column in enumerate(columns):
        shown = [(number, column.position) in percents for number in table.row_numbers]
        if not any(shown) or not (column.unit is None or is_percent(column.unit)):
            continue
        if column.unit is None:
            columns[at] = replace(column, unit="%")
            shown = [True] * len(shown)
        rows = [
            _with_cell(row, column.position, _hundredfold(row[column.position]))
            if as_percentage and column.position < len(row)
            else row
            for row, as_percentage in zip(rows, shown, strict=True)
        ]
    return replace(table, columns=tuple(columns), rows=rows)


def _with_cell(row: list[str], at: int, text: str) -> list[str]:
    return [*row[:at], text, *row[at + 1 :]]


def _hundredfold(text: str) -> str:
    """A hundred times the number, every digit kept; other text as it is."""
    try:
        return repr(float(Decimal(text) * 100))
    except (ArithmeticError, ValueError):
        return text


def _texts(cells: Iterable[object]) -> list[str]:
    """Cells as text, the row cut after its last filled cell; repr keeps every digit."""
    row = ["" if cell is None else repr(cell) if isinstance(cell, float) else str(cell) for cell in cells]
    while row and not row[-1].strip():
        row.pop()
    return row


PROFILE = Profile(name="excel", title="Excel workbook (.xlsx)", recognises=recognises, read=read)
