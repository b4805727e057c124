"""An extensometer that has come to its end, or has lost its mark, writes one strain while the specimen is pulled on."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.records.ended import ended

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.records.record import Record

STAYS = 1e-3
"""Part of its range within which a strain that has stopped stays, on top of four times its noise there."""

LEAST = 10
"""Samples for which it stays at least, and that are left at least."""

NEAR = 20
"""Samples before that by which the strain is seen to move."""

MOVING = 0.3
"""Part of the record's mean rate with which the strain moves at least, until it stops."""

MISSED = 0.05
"""Part of its range by which the strain would have moved on at least."""

ON_ITS_WAY = 0.02
"""Part of the largest force by which the force is off the line that it was on, at most: in a hold it falls at once."""

FIRST = 0.25
"""Part of what follows over which that is asked, and samples before that show the line, `NEAR` at least."""

CHANGES = 0.05
"""Part of the largest force by which the force changes at least: a hold that relaxes nothing is one."""

GOES_ON = 0.5
"""Part of what it changes by in the first half that it changes by in the second at least: relaxation levels off."""

HEATED = 1.0
"""Change of a measured temperature that may make a force go on in a hold, too [°C]."""


def until_strain_stops(record: Record) -> tuple[Record, str]:
    """The record until its strain stops, and a sentence on that; as it is, and no words, where it does not.

    Where a strain is held the force leaves its way at once, and levels off. Where it goes on as if nothing were, the
    strain is not held.
    """
    return ended(
        record,
        _stopped(record),
        "the strain stays at {strain:.4g} from {time:.6g} s on while the force goes on as before: taken for an "
        "extensometer that has stopped",
    )


def _stopped(record: Record) -> int:
    """The first sample at which the strain has stopped, while the specimen is loaded on; else how many there are."""
    count, time, strain = len(record), record.time, record.true_strain
    if count < 2 * LEAST + NEAR:
        return count
    end, whole = strain[-LEAST:], float(np.ptp(strain))
    stays = STAYS * whole + 4.0 * float(np.std(np.diff(end)) / np.sqrt(2.0))
    away = np.abs(strain - np.median(end)) > stays
    first = int(np.flatnonzero(away)[-1]) + 1 if away.any() else 0
    near = max(NEAR, int(FIRST * (count - first)))
    if first < LEAST + near or first > count - LEAST:
        return count
    way = np.sign(record.true_stress[first:].mean())
    rate = way * _slope(time[first - NEAR : first], strain[first - NEAR : first])
    left = float(time[-1] - time[first])
    loaded = np.max(way * strain) <= way * np.median(end) + stays
    moving = rate >= MOVING * whole / float(time[-1] - time[0]) and rate * left >= MISSED * whole
    heated = record.temperature is not None and np.ptp(record.temperature[first:]) > HEATED
    goes_on = loaded and moving and not heated and _force_goes_on(record, first, near)
    return first if goes_on else count


def _force_goes_on(record: Record, first: int, near: int) -> bool:
    """Whether the force after a sample stays on the line of those before, changes, and does not level off."""
    time, force = record.time, record.true_stress * np.exp(-record.true_strain)
    before, after = slice(first - near, first), slice(first, first + near)
    slope = _slope(time[before], force[before])
    line = force[before].mean() + slope * (time[after] - time[before].mean())
    half = (first + len(record)) // 2
    early, late = (
        _slope(time[part], force[part]) * float(np.ptp(time[part])) for part in (slice(first, half), slice(half, None))
    )
    largest = float(np.max(np.abs(force)))
    on_its_way = abs(float(np.mean(force[after] - line))) <= ON_ITS_WAY * largest
    return bool(on_its_way and abs(early + late) >= CHANGES * largest and late * np.sign(early) >= GOES_ON * abs(early))


def _slope(time: FloatArray, values: FloatArray) -> float:
    return float(np.polyfit(time - time[0], values, 1)[0])
