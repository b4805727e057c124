"""How a file would be read, before anything depends on it."""

from collections.abc import Mapping
from dataclasses import dataclass
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from probation._text import printable
from probation.records.assignment import assign_columns
from probation.records.noise import scatter
from probation.records.options import ReadOptions, read_options
from probation.records.profiles import Reading
from probation.records.reading import assemble_all, chosen_tables, open_file
from probation.records.record import Record
from probation.records.table import Column, Table
from probation.records.text_plot import text_plot

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FloatArray = NDArray[np.float64]

_SHOWN_ROWS = 5
_LABELS = {
    "time": ("time", "s"),
    "true_strain": ("true strain", ""),
    "true_stress": ("true stress", "MPa"),
    "strain_rate": ("strain rate", "1/s"),
    "transverse_strain": ("transverse strain", ""),
    "temperature": ("temperature", "°C"),
}


@dataclass(frozen=True, eq=False)
class Preview:
    """How a file would be read.

    Attributes
    ----------
    path : Path
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
    first_rows : tuple of tuple of str
        The first data cells, as they stand.
    rows : int
        Data rows in the file, padding included.
    """

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
    first_rows: tuple[tuple[str, ...], ...]
    rows: int

    def summary(self) -> str:
        """All of it as text, the verdict first, with a plot of each record."""
        parts = [self._verdict(), self._layout(), self._columns()]
        if self.metadata:
            facts = (printable(f"{key}: {text}") for key, text in self.metadata.items())
            parts.append("\n".join(["metadata", *(f"  {fact}" for fact in facts)]))
        parts += [_describe(record) for record in self.records]
        parts.append(self._first_rows())
        return "\n\n".join(parts)

    def plot(self) -> "Figure":
        """Stress over strain, and both over time, of every record."""
        from probation.report.figures import new_figure  # noqa: PLC0415 - a second that reading need not wait for

        figure = new_figure(10.0, 4.0)
        over_strain, over_time = figure.subplots(1, 2)
        strain_axis = over_time.twinx()
        for record in self.records:
            (line,) = over_strain.plot(record.true_strain, record.true_stress, lw=1.0, label=record.id)
            over_time.plot(record.time, record.true_stress, lw=1.0, color=line.get_color())
            strain_axis.plot(record.time, record.true_strain, lw=1.0, ls="--", color=line.get_color())
        over_strain.set(xlabel="true strain [–]", ylabel="true stress [MPa]", title=self.path.name)
        over_time.set(xlabel="time [s]", ylabel="true stress [MPa], solid")
        strain_axis.set_ylabel("true strain [–], dashed")
        if self.records:
            over_strain.legend(frameon=False)
        return figure

    def _verdict(self) -> str:
        known = f"{printable(str(self.path))}: reads as {self.profile} ({self.title})"
        if self.auxiliary:
            return f"{known}: {self.auxiliary}, no stress-strain record"
        count = len(self.records)
        records = "1 record" if count == 1 else f"{count} records, one per specimen"
        warned = sum(len(record.warnings) for record in self.records)
        return f"{known}, {records}" + (f", {warned} warning{'s' if warned > 1 else ''}" if warned else "")

    def _layout(self) -> str:
        headings = f"headings in row {self.header_row}" if self.header_row else "no headings"
        decimal = "comma" if self.decimal == "," else "point"
        separator = f"separator {self.separator}" if self.encoding else self.separator
        facts = [separator, f"decimal {decimal}", headings, f"{self.rows} rows"]
        return "layout    " + ", ".join(([f"encoding {self.encoding}"] if self.encoding else []) + facts)

    def _columns(self) -> str:
        shown = [(printable(label), printable(unit or "no unit"), role) for label, unit, role in self.columns]
        width = max(len(label) for label, _, _ in shown)
        lines = [f"  {label:<{width}}  {unit:<8}  {'→ ' + role if role else 'not used'}" for label, unit, role in shown]
        return "\n".join(["columns", *lines])

    def _first_rows(self) -> str:
        """Show the first rows of the columns in use; of all where none is."""
        used = [at for at, (_, _, role) in enumerate(self.columns) if role] or list(range(len(self.columns)))
        headed = [tuple(label for label, _, _ in self.columns), *self.first_rows]
        lines = ("  " + "  ".join(printable(row[at].strip()) for at in used) for row in headed)
        return "\n".join(["first rows", *lines])


def preview(
    path: str | PathLike[str],
    *,
    profile: str | None = None,
    columns: Mapping[str, str | int] | None = None,
    units: Mapping[str, str] | None = None,
    specimen: Mapping[str, float] | None = None,
    specimen_index: int | None = None,
    sheet: str | None = None,
) -> Preview:
    """Show how a file would be read; parameters as in `read_records`.

    Raises
    ------
    InputError
        Where reading it would; a file without stress-strain records is shown, not refused.
    """
    path = Path(path)
    options = read_options(
        path,
        profile=profile,
        columns=columns,
        units=units,
        specimen=specimen,
        specimen_index=specimen_index,
        sheet=sheet,
    )
    source, found, reading = open_file(path, options)
    _, table = chosen_tables(path, reading, specimen_index)[0]
    records = () if reading.auxiliary else assemble_all(source, found, reading, options)
    return Preview(
        path=path,
        profile=found.name,
        title=found.title,
        encoding="" if found.name == "excel" else source.encoding,
        separator=reading.separator,
        decimal=table.decimal,
        header_row=table.header_row,
        columns=_columns_with_roles(table, reading, options),
        records=records,
        auxiliary=reading.auxiliary,
        metadata=reading.metadata,
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


def _describe(record: Record) -> str:
    """One record in text: ranges, sampling, noise, warnings and a plot."""
    duration = record.time[-1] - record.time[0]
    lines = [f"{record.id}: {len(record)} samples over {duration:.6g} s, {_sampling(record.time)}"]
    for name, values in record.samples.items():
        label, unit = _LABELS[name]
        noise = ""
        if name in ("true_strain", "true_stress"):
            noise = f", noise about {scatter(record.time, values):.2g} {unit}".rstrip()
        span = f"{values.min() + 0.0:.6g} to {values.max() + 0.0:.6g} {unit}".rstrip()  # + 0.0: no "-0"
        lines.append(f"  {label:<17}  {span}{noise}")
    lines += [f"  warning: {warning}" for warning in record.warnings]
    lines.append(text_plot(record.true_strain, record.true_stress, "true strain [–]", "true stress [MPa]"))
    return "\n".join(lines)


def _sampling(time: FloatArray) -> str:
    steps = np.diff(time)
    if steps.max() - steps.min() <= 1e-3 * np.median(steps):
        return f"every {np.median(steps):.4g} s"
    return f"unevenly, every {steps.min():.4g} to {steps.max():.4g} s (median {np.median(steps):.4g} s)"
