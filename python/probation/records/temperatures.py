"""Temperatures logged in a file of their own, brought onto a record's instants."""

from dataclasses import replace
from pathlib import Path

import numpy as np

from probation._complaint import bad_input, quoted
from probation.records.assignment import find_column
from probation.records.checks import find_excess, find_fault, find_short_step, refusal
from probation.records.opening import chosen_tables, open_file
from probation.records.options import ReadOptions
from probation.records.record import Record
from probation.settings.reading import READING

_ROLES = ("time", "temperature")


def with_temperature(record: Record, path: Path, specimen_index: int = 1) -> Record:
    """Copy a record, with temperatures interpolated from a log of the same test.

    Parameters
    ----------
    path : Path
        A file whose profile finds time [s] and temperature [°C]; both clocks start together.
    specimen_index : int
        Which of the file's specimens, counted from 1.

    Raises
    ------
    InputError
        If the file holds no temperatures, or starts or ends more than a tenth of the record's
        duration inside it. Nearer than that, the log's end value is held, with a warning.
    """
    _, _, reading = open_file(path, ReadOptions())
    ((_, table),) = chosen_tables(path, reading, specimen_index)
    if not set(_ROLES) <= set(table.roles):
        raise bad_input(path, "no temperatures over time", "a temperature log")
    columns = {role: find_column(table, table.roles[role]) for role in _ROLES}
    log = {role: table.numbers(column) for role, column in columns.items()}
    if fault := find_fault(log) or find_excess(log) or find_short_step("time", log["time"]):
        raise refusal(table, columns, fault)
    time, begin, end = log["time"], float(record.time[0]), float(record.time[-1])
    missing = max(float(time[0]) - begin, end - float(time[-1]), 0.0)
    if missing > READING.log_missing * (end - begin):
        raise bad_input(
            path,
            f"temperatures from {time[0]:g} to {time[-1]:g} s",
            f"the span of record {quoted(record.id)}, {begin:g} to {end:g} s",
        )
    held = (f"temperature held for {missing:.3g} s outside its log",) if missing > 0 else ()
    return replace(
        record,
        temperature=np.interp(record.time, time, log["temperature"]),
        warnings=(*record.warnings, *held),
    )
