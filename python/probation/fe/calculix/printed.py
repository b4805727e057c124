"""What ``*NODE PRINT`` writes into job.dat."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.errors import InputError

if TYPE_CHECKING:
    from pathlib import Path

    from probation._arrays import FloatArray

_HEADING = re.compile(r"^ (displacements|forces|total force) \(.*\) for set (\S+) and time +(\S+)$")


@dataclass(frozen=True, eq=False)
class Printed:
    """One quantity of one set of nodes at every increment that printed it.

    Attributes
    ----------
    time : ndarray, shape (increments,) [s]
        Total time; printed with seven digits.
    nodes : tuple of int
        In the order of `values`; empty for a total.
    values : ndarray, shape (increments, nodes, 3)
        Displacements [mm] or forces [N]; one row for a total.
    """

    time: FloatArray
    nodes: tuple[int, ...]
    values: FloatArray


def read_printed(file: Path) -> dict[tuple[str, str], Printed]:
    """Read job.dat.

    Returns
    -------
    dict
        Of (quantity, set), the quantity one of "displacements", "forces", "total force" and the set in capitals.

    Raises
    ------
    InputError
        If there is no such file, nothing in it, or a line that is none of these.
    """
    if not file.is_file():
        raise InputError(f"{file}: no such file; ccx printed nothing")
    times: dict[tuple[str, str], list[float]] = {}
    rows: dict[tuple[str, str], list[list[float]]] = {}
    key = None
    for number, line in enumerate(file.read_text().splitlines(), start=1):
        if not line.strip():
            continue
        if heading := _HEADING.match(line.rstrip()):
            key = heading[1], heading[2]
            times.setdefault(key, []).append(float(heading[3]))
            rows.setdefault(key, [])
            continue
        try:
            row = [float(number) for number in line.split()]
        except ValueError:
            row = []
        if key is None or len(row) != (3 if key[0] == "total force" else 4):
            raise InputError(f"{file}, line {number}: found {line.strip()!r}, expected node, x, y, z")
        rows[key].append(row)
    if not times:
        raise InputError(f"{file}: nothing was printed")
    return {time: _printed(file, time, times[time], rows[time]) for time in times}


def _printed(file: Path, key: tuple[str, str], times: list[float], rows: list[list[float]]) -> Printed:
    """The rows of all increments as one array."""
    if not rows or len(rows) % len(times):
        raise InputError(f"{file}: found {len(rows)} rows of {key[0]} of {key[1]} in {len(times)} increments")
    values = np.array(rows).reshape(len(times), len(rows) // len(times), -1)
    nodes = () if values.shape[2] == 3 else tuple(int(node) for node in values[0, :, 0])
    return Printed(np.array(times), nodes, values[:, :, -3:])
