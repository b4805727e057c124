"""Samples after a break are none of the specimen's: a machine goes on writing until somebody stops it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.records.ended import ended

if TYPE_CHECKING:
    from probation.records.record import Record

LEFT = 0.1
"""Part of the largest force that is left at most, from the break to the record's end."""

BORNE = 0.5
"""The same that the specimen bore at least just before."""

WHOLE = 0.9
"""Part of what it bore just before that the last sample of a whole specimen bears at least."""

SUDDEN = 5
"""Samples within which the force falls from one to the other: a logger's filter takes some."""

MOVING = 0.3
"""Part of the rate before the break with which the strain goes on at least, and of the record's mean rate that this is:
in a hold a force may fall by itself, and while the strain is taken back it does."""

NEAR = 20
"""Samples before the break, and after it, by which the strain is seen to move: from one to another noise may hide
it."""

LEAST = 10
"""Samples that are left at least."""


def until_break(record: Record) -> tuple[Record, str]:
    """The record until its specimen broke, and a sentence on that; as it is, and no words, where it did not.

    A specimen has broken where all of its force is gone within some samples, for good, while it is stretched on.
    """
    return ended(
        record,
        _end(record),
        "the force falls to less than a tenth at {time:.6g} s while the specimen is stretched on: taken for its break",
    )


def _end(record: Record) -> int:
    """How many samples the specimen was whole for."""
    force = np.abs(record.true_stress * np.exp(-record.true_strain))
    if not force.any():
        return len(record)
    borne = force >= LEFT * np.max(force)
    gone = int(np.flatnonzero(borne)[-1]) + 1  # from here on to the end there is none
    first = max(gone - SUDDEN, 0)
    before = force[first:gone]
    if gone == len(record) or first < LEAST or np.max(before) < BORNE * np.max(force):
        return len(record)
    if np.max(record.true_stress[first:gone]) <= 0.0:  # a compressive force that goes back to none
        return len(record)
    last = first + int(np.flatnonzero(before >= WHOLE * np.max(before))[-1])
    return last + 1 if _goes_on(record, last, gone) else len(record)


def _goes_on(record: Record, last: int, gone: int) -> bool:
    """Whether the strain moves on from one sample to beyond another as it did before, and as it does on the whole."""
    time, strain = record.time, record.true_strain
    near, after = slice(max(last + 1 - NEAR, 0), last + 1), slice(gone, gone + NEAR)
    rate, there = np.polyfit(time[near] - time[last], strain[near], 1)
    moved = (np.mean(strain[after]) - there) / (np.mean(time[after]) - time[last])
    usual = np.ptp(strain) / (time[-1] - time[0])
    return bool(rate > MOVING * usual and moved > MOVING * rate)
