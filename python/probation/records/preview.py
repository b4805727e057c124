"""How a file would be read, before anything depends on it."""

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Unpack

import numpy as np
from numpy.typing import NDArray

from probation.records.assignment import assign_columns
from probation.records.opening import chosen_tables, open_file
from probation.records.options import ReadingKeys, ReadOptions, read_options
from probation.records.profiles import Reading
from probation.records.profiles.excel import recognises as is_workbook
from probation.records.reading import assemble_all
from probation.records.record import Record
from probation.records.table import Column, Table
from probation.results.data import Stored
from probation.results.rendering import Plotted, Summarised

FloatArray = NDArray[np.float64]

_SHOWN_ROWS = 5
"""First rows that a preview shows."""


@dataclass(frozen=True, eq=False)
class Preview(Summarised, Plotted, Stored):
    """How a file would be read.

    `plot` draws stress over strain, and both over time, of every record. In JSON the records are whole, as the summary
    draws them, too.

    Attributes
    ----------
    profile, title : str
        Import profile, and what it is.
    encoding, separator, decimal : str
        For people; the encoding is empty for a workbook.
    header_row : int or None
        The file's row of the headings, counted from 1.
    columns : tuple of (heading, unit, role)
        What the file has; unit and role None where there is none.
    records : tuple of Record
        What it reads as; empty where it holds no stress-strain record.
    auxiliary : str
        What it holds instead.
    metadata : dict of str to str
    specimen : dict of str to float
        ``area_mm2`` and ``gauge_length_mm``, where the file states them.
    first_rows : tuple of tuple of str
        The first data cells, as they stand.
    rows : int
        Data rows in the file, padding included.
    """

    SCHEMA: ClassVar[str] = "probation.preview/1"

    path: Path
    profile: str
    title: str
    encoding: str
    separator: str
    decimal: str
    header_row: int | None
    columns: tuple[tuple[str, str | None, str | None], ...]
    records: tuple[Record, ...]
    auxiliary: str
    metadata: Mapping[str, str]
    specimen: Mapping[str, float]
    first_rows: tuple[tuple[str, ...], ...]
    rows: int

    def to_dict(self) -> dict[str, Any]:
        """How the file would be read, as Python objects; the samples are in the records."""
        return {
            "file": str(self.path),
            "profile": self.profile,
            "title": self.title,
            "encoding": self.encoding,
            "separator": self.separator,
            "decimal": self.decimal,
            "header_row": self.header_row,
            "rows": self.rows,
            "columns": [{"heading": heading, "unit": unit, "role": role} for heading, unit, role in self.columns],
            "records": [record.to_dict() for record in self.records],
            "holds_instead": self.auxiliary,
            "specimen": dict(self.specimen),
            "metadata": dict(self.metadata),
            "first_rows": self.first_rows,
        }


def preview(path: str | PathLike[str], **how: Unpack[ReadingKeys]) -> Preview:
    """Show how a file would be read.

    Parameters
    ----------
    path : path-like
        CSV/TSV, .xlsx, or whatever an import profile reads; may be gzipped.
    **how
        How it is read (`records.options.ReadingKeys`): ``profile``, ``columns``, ``units``, ``specimen``,
        ``specimen_index``, ``sheet``.

    Raises
    ------
    InputError
        Where reading it would; a file without stress-strain records is shown, not refused.
    """
    path = Path(path)
    options = read_options(path, **how)
    source, profile, reading = open_file(path, options)
    _, table = chosen_tables(path, reading, options.specimen_index)[0]
    records = () if reading.auxiliary else assemble_all(source, profile, reading, options)
    return Preview(
        path=path,
        profile=profile.name,
        title=profile.title,
        encoding="" if is_workbook(source) else source.encoding,
        separator=reading.separator,
        decimal=table.decimal,
        header_row=table.header_row,
        columns=_columns_with_roles(table, reading, options),
        records=records,
        auxiliary=reading.auxiliary,
        metadata=reading.metadata,
        specimen=table.specimen,
        first_rows=_first_rows(table),
        rows=len(table.rows),
    )


def _columns_with_roles(
    table: Table, reading: Reading, options: ReadOptions
) -> tuple[tuple[str, str | None, str | None], ...]:
    assigned: dict[str, Column] = {} if reading.auxiliary else assign_columns(table, options)
    roles = {column.position: role for role, column in assigned.items()}
    stated = {column.position: column.unit for column in assigned.values()}
    return tuple(
        (
            column.label or "(no heading)",
            options.units.get(roles.get(column.position, "")) or stated.get(column.position, column.unit),
            roles.get(column.position),
        )
        for column in table.columns
    )


def _first_rows(table: Table) -> tuple[tuple[str, ...], ...]:
    columns = [table.cells(column)[:_SHOWN_ROWS] for column in table.columns]
    return tuple(zip(*columns, strict=True))
