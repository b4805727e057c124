"""A strain history from a file: time and true strain, perhaps the strain rate."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Unpack

import numpy as np

from probation._complaint import bad_input, listed, quoted
from probation.histories import ImposedHistory
from probation.records.checks import find_excess, find_short_step, refusal
from probation.records.opening import open_file
from probation.records.options import ReadingKeys, ReadOptions
from probation.records.roles import ROLES, role_of
from probation.records.source import Source
from probation.records.strain_history import read_strain_history
from probation.records.strain_limits import expected_strain, impossible_sample
from probation.records.units import convert

if TYPE_CHECKING:
    from os import PathLike

    from probation._arrays import FloatArray
    from probation.records.table import Column, Table

_WANTED = ("time", "true_strain", "strain_rate")


@dataclass(frozen=True)
class HistoryFile:
    """What a file imposes, and its hash."""

    history: ImposedHistory
    sha256: str


def read_history(path: str | PathLike[str], **how: Unpack[ReadingKeys]) -> HistoryFile:
    """Read ``time_s,true_strain`` (and ``strain_rate_per_s``, if there); other columns are left alone.

    Separators, decimal marks, encodings and units as for records; where any of `how` is given, any strain
    of a record will do.

    Parameters
    ----------
    path : path-like
    **how
        How the file is read, as in `preview`.

    Raises
    ------
    InputError
        At the first thing that is wrong, naming file, row, column, what was found and what was expected.
    """
    path = Path(path)
    if any(how.values()):
        measured = read_strain_history(path, **how)
        history = ImposedHistory(
            path.name, measured.time, true_strain=measured.true_strain, strain_rate=measured.strain_rate
        )
        return HistoryFile(history, Source.open(path).sha256)
    source, _, reading = open_file(path, ReadOptions())
    if reading.auxiliary or len(reading.tables) != 1:
        held = reading.auxiliary or f"{len(reading.tables)} specimens side by side"
        raise bad_input(path, held, "one strain history, time_s,true_strain")
    table = reading.tables[0]
    columns = _columns(table)
    samples = {role: _samples(table, role, columns[role]) for role in _WANTED if role in columns}
    if fault := find_excess(samples):
        raise refusal(table, columns, fault)
    _check_time(table, columns["time"], samples["time"])
    _check_strain(table, columns["true_strain"], samples["true_strain"])
    if fault := find_short_step("time", samples["time"]):
        raise refusal(table, columns, fault)
    history = ImposedHistory(
        path.name, samples["time"], true_strain=samples["true_strain"], strain_rate=samples.get("strain_rate")
    )
    return HistoryFile(history, source.sha256)


def _columns(table: Table) -> dict[str, Column]:
    found: dict[str, Column] = {}
    for column in table.columns:
        role = table.roles.get(column.label) or role_of(column.name)
        if role not in _WANTED:
            continue
        if role in found:
            raise bad_input(
                table.path,
                f"a second column for {role}, in addition to {quoted(found[role].label)}",
                "one",
                row=table.header_row,
                column=column.label,
            )
        found[role] = column
    for role, heading in (("time", "time_s"), ("true_strain", "true_strain")):
        if role not in found:
            labels = [column.label for column in table.columns]
            what = f"no column {quoted(heading)} among {listed(labels, 'and')}"
            raise bad_input(table.path, what, "the headings time_s,true_strain", row=table.header_row)
    return found


def _samples(table: Table, role: str, column: Column) -> FloatArray:
    values = table.numbers(column)
    bad = np.flatnonzero(~np.isfinite(values))
    if bad.size:
        cell = table.cells(column)[bad[0]].strip()
        raise bad_input(
            table.path,
            quoted(cell) if cell else "an empty cell",
            "a finite number",
            row=table.row_numbers[bad[0]],
            column=column.label,
        )
    if column.unit is None:
        return values
    try:
        return convert(values, column.unit, ROLES[role].unit)
    except ValueError as failure:
        raise bad_input(table.path, str(failure), ROLES[role].kind, row=table.header_row, column=column.label) from None


def _check_time(table: Table, column: Column, time: FloatArray) -> None:
    if len(time) < 2:
        raise bad_input(table.path, "one instant", "at least two", row=table.row_numbers[0], column=column.label)
    backward = np.flatnonzero(np.diff(time) <= 0.0)
    if backward.size:
        at = int(backward[0]) + 1
        raise bad_input(
            table.path,
            f"{time[at]:.10g} after {time[at - 1]:.10g}",
            "time that increases from row to row",
            row=table.row_numbers[at],
            column=column.label,
        )


def _check_strain(table: Table, column: Column, true_strain: FloatArray) -> None:
    stated = column.unit is not None
    bad = impossible_sample("true_strain", true_strain, true_strain, stated)
    if bad is not None:
        raise bad_input(
            table.path,
            f"true strain {true_strain[bad]:.10g}" + ("" if stated else " without a unit"),
            expected_strain("true_strain", stated),
            row=table.row_numbers[bad],
            column=column.label,
            remedy="check its unit" if stated else 'if it is in percent, head the column "true_strain (%)"',
        )
