"""Samples that are no readings: a spike of a logger, a gap that was filled with 0 or -9999."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import median_filter

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.records.record import Record

BEYOND = 3.0
"""How many times as large as any other a reading is that is none: a test has no force of that size for an instant."""

WIDTH = 5
"""Samples of which the middle one in size is taken: two readings side by side may be wrong."""

ALONE = 10.0
"""How many times as far from both its neighbours a reading lies as these and the next two move by from one to another:
at a reversal it is once."""

NEAR = 3
"""Samples on either side whose steps count."""

LARGE = 0.1
"""Part of the largest reading by which it lies off at least: what is less is noise, which may have outliers."""

MOST = 0.02
"""Part of a record's samples that are left out at most: what happens more often is not by accident."""


def without_glitches(record: Record) -> tuple[Record, str]:
    """The record without them, and a sentence on that; as it is, and no words, where there are none."""
    wild = {"stress": _wild(record.true_stress), "strain": _wild(record.true_strain)}
    left_out = np.flatnonzero(wild["stress"] | wild["strain"])
    if not 0 < len(left_out) <= max(MOST * len(record), 1.0):
        return record, ""
    of = " and ".join(name for name, which in wild.items() if which.any())
    at = ", ".join(f"{record.time[index]:.6g}" for index in left_out[:3]) + (", …" if len(left_out) > 3 else "")
    samples = "1 sample was" if len(left_out) == 1 else f"{len(left_out)} samples were"
    kept = np.ones(len(record), dtype=np.bool_)
    kept[left_out] = False
    why = f"its {of} is elsewhere for an instant, at {at} s: taken for no reading; {samples} left out"
    return record.only(kept), why


def _wild(values: FloatArray) -> NDArray[np.bool_]:
    """Which samples are no readings, shape (n,)."""
    size = np.abs(values)
    usual = float(np.max(median_filter(size, WIDTH, mode="nearest")))
    if usual == 0.0 or len(values) < 2 * NEAR + 1:
        return np.zeros(len(values), dtype=np.bool_)
    wild = size > BEYOND * usual
    step = np.abs(np.diff(values))
    off = np.abs(values[1:-1] - 0.5 * (values[:-2] + values[2:]))
    for index in 1 + np.flatnonzero(off > LARGE * usual):
        before, after = step[max(index - NEAR, 0) : index - 1], step[index + 1 : index + NEAR]
        across = abs(values[index + 1] - values[index - 1])
        wild[index] |= off[index - 1] > ALONE * max(*before, *after, across)
    return wild
