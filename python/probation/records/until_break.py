"""Samples after a break are none of the specimen's: a machine goes on writing until somebody stops it."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

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
"""Part of the rate before the break with which the strain goes on at least: in a hold a force may fall by itself, and
while the strain is taken back it does."""

LEAST = 10
"""Samples that are left at least."""


def until_break(record: Record) -> tuple[Record, str]:
    """The record until its specimen broke, and a sentence on that; as it is, and no words, where it did not.

    A specimen has broken where all of its force is gone within some samples, for good, while it is stretched on.
    """
    end = _end(record)
    if end == len(record):
        return record, ""
    note = (
        f"the force falls to less than a tenth at {record.time[end]:.6g} s while the specimen is stretched on: taken "
        f"for its break; the {len(record) - end} samples from there on were left out"
    )
    return record.only(slice(end)), note


def _end(record: Record) -> int:
    """How many samples the specimen was whole for."""
    force = np.abs(record.true_stress * np.exp(-record.true_strain))
    borne = force >= LEFT * np.max(force)
    gone = int(np.flatnonzero(borne)[-1]) + 1  # from here on to the end there is none
    first = max(gone - SUDDEN, 0)
    before = force[first:gone]
    if gone == len(record) or first < LEAST or np.max(before) < BORNE * np.max(force):
        return len(record)
    last = first + int(np.flatnonzero(before >= WHOLE * np.max(before))[-1])
    time, strain = record.time, record.true_strain
    rate = (strain[last] - strain[first - SUDDEN]) / (time[last] - time[first - SUDDEN])
    moved = (strain[gone] - strain[last]) / (time[gone] - time[last])
    return last + 1 if rate > 0.0 and moved > MOVING * rate else len(record)
