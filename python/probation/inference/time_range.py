"""Relaxation times that are worth searching for on given records."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation.law.modal import Law
    from probation.records.record import Record

BEYOND = 1e3
"""How far beyond the records' own times, and how far from 1 for alpha, is searched [-]."""


def time_range(records: Iterable[Record], law: Law) -> tuple[float, float]:
    """Range of tau_max [s] (or alpha [-]): from far below the shortest step to far beyond the longest record."""
    if law.companion is not None:
        return 1.0 / BEYOND, BEYOND
    times = [record.time for record in records]
    shortest = min(float(np.min(np.diff(instants))) for instants in times)
    return shortest / BEYOND, BEYOND * max(float(np.ptp(instants)) for instants in times)
