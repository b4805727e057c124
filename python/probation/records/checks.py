"""What samples must satisfy before anything may be computed from them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from probation._complaint import bad_input
from probation.errors import InputError
from probation.limits import LARGEST, SHORTEST_STEP, SMALLEST
from probation.records.roles import ROLES
from probation.settings.reading import READING

if TYPE_CHECKING:
    from probation.records.table import Column, Table

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Fault:
    """The first thing wrong with a set of samples.

    Attributes
    ----------
    quantity : str
        Which of the sampled quantities.
    sample : int
        Index of the sample, from 0.
    """

    quantity: str
    sample: int
    found: str
    expected: str
    remedy: str = ""


def find_fault(samples: Mapping[str, FloatArray], minimum: int = READING.fewest_samples) -> Fault | None:
    """First fault of a record's samples, or None.

    Parameters
    ----------
    samples : mapping of str to ndarray, shape (n,)
        By quantity; the first of them is the time.
    minimum : int
        Fewest samples.
    """
    for quantity, values in samples.items():
        bad = np.flatnonzero(~np.isfinite(values))
        if bad.size:
            return Fault(quantity, int(bad[0]), str(values[bad[0]]), "a finite number", "remove or repair the row")
    quantity, time = next(iter(samples.items()))
    if len(time) < minimum:
        points = "point" if len(time) == 1 else "points"
        return Fault(quantity, len(time) - 1, f"{len(time)} {points}", f"at least {minimum}")
    steps = np.diff(time)
    if (backward := np.flatnonzero(steps <= 0)).size:
        at = int(backward[0]) + 1
        repeats = steps[at - 1] == 0
        return Fault(
            quantity,
            at,
            f"{time[at]:.10g} again" if repeats else f"time going back from {time[at - 1]:.10g} to {time[at]:.10g}",
            "time that increases from row to row",
            "remove the repeated row" if steps[at - 1] == 0 else "sort the rows, or split the file where time restarts",
        )
    return None


def find_excess(samples: Mapping[str, FloatArray]) -> Fault | None:
    """First sample beyond what physics allows (`limits.LARGEST`, `limits.SMALLEST`), or None.

    Parameters
    ----------
    samples : mapping of str to ndarray, shape (n,)
        By quantity, in internal units; infinite where a conversion has left all numbers.
    """
    for quantity, values in samples.items():
        largest = LARGEST.get(quantity, np.inf)  # a true strain has its own: `strain_limits`
        beyond = np.flatnonzero(np.abs(values) > largest)
        if beyond.size:
            unit = ROLES[quantity].unit.removeprefix("dimensionless")
            return Fault(
                quantity,
                int(beyond[0]),
                f"{values[beyond[0]]:.4g} {unit}".rstrip(),
                f"at most {largest:g} {unit}".rstrip() + " in magnitude",
                "check the number and its unit",
            )
        magnitude = float(np.abs(values).max())
        if 0.0 < magnitude < SMALLEST.get(quantity, 0.0):
            at = int(np.abs(values).argmax())
            least = f"at least {SMALLEST[quantity]:g} {ROLES[quantity].unit.removeprefix('dimensionless')}".rstrip()
            return Fault(quantity, at, f"{magnitude:.4g} as the largest", least, "check the numbers and their unit")
    return None


def refusal(table: Table, columns: Mapping[str, Column], fault: Fault) -> InputError:
    """A fault of a file's samples, by row and column."""
    return bad_input(
        table.path,
        fault.found,
        fault.expected,
        row=table.row_numbers[fault.sample],
        column=columns[fault.quantity].label,
        remedy=fault.remedy,
    )


def find_short_step(quantity: str, time: FloatArray) -> Fault | None:
    """First sample that follows the one before sooner than `limits.SHORTEST_STEP`, or None."""
    short = np.flatnonzero(np.diff(time) < SHORTEST_STEP)
    if not short.size:
        return None
    step = time[short[0] + 1] - time[short[0]]
    return Fault(
        quantity,
        int(short[0]) + 1,
        f"{step:.4g} s after the sample before",
        f"at least {SHORTEST_STEP:g} s",
        "check the unit of time",
    )
