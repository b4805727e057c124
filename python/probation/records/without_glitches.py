"""Samples that are no readings: a spike of a logger, a gap that was filled with 0 or -9999."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import median_filter

from probation.records.runs import runs

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.records.record import Record

BEYOND = 3.0
"""How many times as large as any other a reading is that is none: a test has no force of that size for an instant."""

WIDTH = 5
"""Samples of which the middle one in size is taken: two readings side by side may be wrong."""

FILLED = 0.5
"""Part of the largest reading that those on either side of one that is exactly 0 have at least, if it was filled in."""

MOST = 0.02
"""Part of a record's samples that are left out at most: what happens more often is not by accident."""

LEAST = 10
"""Samples that are left at least."""

STEP, SUDDEN = 0.05, 5.0
"""Part of a channel's range, and times its usual step, from which on it steps: what the other channel does then is the
specimen's, however high its peak."""


def without_glitches(record: Record) -> tuple[Record, str]:
    """The record without them, and a sentence on that; as it is, and no words, where there are none."""
    stress, strain = record.true_stress, record.true_strain
    wild = {  # of what the other channel follows, an impact or a step, both are readings
        "stress": (_beyond(stress) & ~_stepped(strain)) | _filled(stress),
        "strain": (_beyond(strain) & ~_stepped(stress)) | _filled(strain),
    }
    left_out = np.flatnonzero(wild["stress"] | wild["strain"])
    if not 0 < len(left_out) <= max(MOST * len(record), 1.0) or len(record) - len(left_out) < LEAST:
        return record, ""
    channels = [name for name, which in wild.items() if which.any()]
    of = f"its {' and '.join(channels)} {'is' if len(channels) == 1 else 'are'}"
    at = ", ".join(f"{record.time[index]:.6g}" for index in left_out[:3]) + (", …" if len(left_out) > 3 else "")
    samples = "1 sample was" if len(left_out) == 1 else f"{len(left_out)} samples were"
    kept = np.ones(len(record), dtype=np.bool_)
    kept[left_out] = False
    why = f"{of} elsewhere for an instant, at {at} s: taken for no reading; {samples} left out"
    return record.only(kept), why


def _beyond(values: FloatArray) -> NDArray[np.bool_]:
    """Which samples are far beyond all others, shape (n,)."""
    usual = _usual(values)
    return np.asarray((np.abs(values) > BEYOND * usual) & (usual > 0.0))


def _filled(values: FloatArray) -> NDArray[np.bool_]:
    """Which samples were filled with 0, one or two between large ones; shape (n,)."""
    large, filled = FILLED * _usual(values), np.zeros(len(values), dtype=np.bool_)
    for run in runs(values == 0.0):
        if run.start > 0 and run.stop < len(values) and run.stop - run.start <= WIDTH // 2:
            before, after = values[run.start - 1], values[run.stop]
            filled[run] = before * after > 0.0 and min(abs(before), abs(after)) > large
    return filled


def _usual(values: FloatArray) -> float:
    """The largest size but for readings that stand alone."""
    return float(np.max(median_filter(np.abs(values), WIDTH, mode="mirror")))


def _stepped(values: FloatArray) -> NDArray[np.bool_]:
    """Which samples a channel steps into or out of, shape (n,)."""
    step = np.abs(np.diff(values))
    steps = step > np.maximum(SUDDEN * np.median(step), STEP * np.ptp(values))
    return np.asarray(np.append(steps, False) | np.append(False, steps))
