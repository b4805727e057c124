"""Relaxation times that are worth searching for on given records."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.settings.identification import IDENTIFICATION

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.law.modal import Law
    from probation.records.record import Record


def time_range(records: Iterable[Record], law: Law) -> tuple[float, float]:
    """Range of tau_max [s] (or alpha [-]): from far below the shortest step to far beyond the longest record."""
    if law.companion is not None:
        return 1.0 / IDENTIFICATION.beyond_records, IDENTIFICATION.beyond_records
    times = [record.time for record in records]
    shortest = min(float(np.min(np.diff(instants))) for instants in times)
    return shortest / IDENTIFICATION.beyond_records, IDENTIFICATION.beyond_records * max(
        float(np.ptp(instants)) for instants in times
    )
