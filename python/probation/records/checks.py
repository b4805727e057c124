"""What samples must satisfy before anything may be computed from them."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.records.record import Record

FloatArray = NDArray[np.float64]

MINIMUM_SAMPLES = 10


@dataclass(frozen=True)
class Fault:
    """The first thing wrong with a set of samples.

    Attributes
    ----------
    quantity : str
        Which of the sampled quantities.
    sample : int
        Index of the sample, from 0.
    found, expected, remedy : str
    """

    quantity: str
    sample: int
    found: str
    expected: str
    remedy: str = ""


def require_signal(record: "Record") -> None:
    """Refuse a record that a law cannot be put against: its strain does not move, or it bears no stress.

    Raises
    ------
    InputError
        It names the record.
    """
    strain = record.true_strain
    if np.ptp(strain) == 0.0:
        raise InputError(
            f"record {quoted(record.id)}: found a true strain of {strain[0]:.4g} at every sample, expected a strain "
            "that changes; check the column, or leave the record out"
        )
    if not record.true_stress.any():
        raise InputError(
            f"record {quoted(record.id)}: found a true stress of 0 MPa at every sample, expected a test under load; "
            "check the column and its unit, or leave the record out"
        )


def find_fault(samples: Mapping[str, FloatArray], minimum: int = MINIMUM_SAMPLES) -> Fault | None:
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
