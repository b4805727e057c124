"""Records that look as if a unit or a sign was mistaken: a warning, since a test may be so."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.records.record import Record

OTHER_UNIT = 50.0
"""Ratio of a record's largest stress to the nearest of the others from which on a unit is asked for: rates and
temperatures of one campaign change it by ten, a unit by a thousand."""


def unlike_others(records: Sequence[Record]) -> tuple[str, ...]:
    """A sentence on each record whose stress pushes while it is stretched, or is far larger or smaller than any other.

    Parameters
    ----------
    records : sequence of Record
        Of one campaign.
    """
    records = [record for record in records if record.true_stress.any()]
    largest = [float(np.max(np.abs(record.true_stress))) for record in records]
    notes = []
    for index, record in enumerate(records):
        if np.trapezoid(record.true_stress, record.true_strain) < 0.0:  # no specimen gives work back at large
            notes.append(
                f"{record.id}: its stress and its strain have opposite signs: if tension is positive in both, one of "
                "them has the wrong sign"
            )
        others = largest[:index] + largest[index + 1 :]
        nearest = min(others, key=lambda other: abs(np.log(other / largest[index])), default=largest[index])
        if not 1.0 / OTHER_UNIT < nearest / largest[index] < OTHER_UNIT:
            notes.append(
                f"{record.id}: its largest stress is {largest[index]:.3g} MPa, that of the record nearest to it "
                f"{nearest:.3g} MPa: is its force in another unit?"
            )
    return tuple(notes)
