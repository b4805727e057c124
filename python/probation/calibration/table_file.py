"""A table of rates and relaxation times from a file."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._complaint import bad_input
from probation.calibration.rate_table import RateTable
from probation.records.opening import open_file
from probation.records.options import ReadOptions

if TYPE_CHECKING:
    from pathlib import Path

    from probation._arrays import FloatArray

_HEADINGS = {
    "rates": ("rate", "strain_rate", "strain rate"),
    "tau_max": ("tau_max",),
    "se": ("se", "tau_max_se", "standard error"),
    "hardening_modulus": ("hardening_modulus", "g"),
}
_UNITS = ("_per_s", "_s", "_mpa")


def read_rate_table(path: Path) -> RateTable | None:
    """Read ``rate_per_s,tau_max_s`` and, where there are, ``se_s`` and ``hardening_modulus_MPa``.

    Parameters
    ----------
    path : Path
        CSV, TSV or .xlsx.

    Returns
    -------
    RateTable or None
        None where the file has no column of rates with one of tau_max: it is something else.

    Raises
    ------
    InputError
        At the first number that is missing or not possible, naming file and row.
    """
    table = open_file(path, ReadOptions())[2].tables[0]
    columns: dict[str, FloatArray] = {}
    for column in table.columns:
        name = column.name.strip().casefold()
        for unit in _UNITS:
            name = name.removesuffix(unit)
        for role, headings in _HEADINGS.items():
            if name in headings and role not in columns:
                values = table.numbers(column)
                empty = np.flatnonzero(~np.isfinite(values))
                if empty.size and {"rates", "tau_max"} & {role, *columns}:
                    row = table.row_numbers[int(empty[0])]
                    raise bad_input(path, "an empty cell", "a number", row=row, column=column.label)
                columns[role] = values
    if not {"rates", "tau_max"} <= set(columns):
        return None
    if "time" in {column.name.strip().casefold() for column in table.columns}:
        return None
    return RateTable(**columns, labels=tuple(f"row {number}" for number in table.row_numbers), source=str(path))
