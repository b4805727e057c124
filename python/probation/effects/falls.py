"""Where the force of a record falls within a sample or two, and by how much: read off the record."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from probation.normal import SD_OF_MEDIAN
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

_NEAR = 3
"""Differences before and after, at a distance, whose medians are what the force does there anyway: relaxing, the lower
of them."""

_BESIDE = 2
"""Samples beside a fall in which a spike comes back; nor is a fall nearer to a jump of the rate."""

_STAYS = 0.2
"""Part of a fall that is there after these samples, at least."""


class Fall(NamedTuple):
    """A sudden fall of the force.

    Attributes
    ----------
    instant : float
        Part of the record's duration.
    size : float
        Of the nominal stress [MPa].
    """

    instant: float
    size: float


def falls_of(view: RecordView) -> tuple[Fall, ...]:
    """All of a record, in the order of time."""
    return _falls_of(view.same_data or view)


@lru_cache(maxsize=64)
def _falls_of(view: RecordView) -> tuple[Fall, ...]:
    time, force = view.sampled(view.elapsed), view.data / view.sampled(view.stretch)
    change = np.diff(force)
    apart = _NEAR + 1
    medians = np.median(sliding_window_view(np.pad(change, apart, mode="edge"), _NEAR), axis=1)
    beyond = np.minimum(medians[: len(change)], medians[-len(change) :]) - change
    least = EFFECTS.sharp_fall * SD_OF_MEDIAN * float(np.median(np.abs(beyond)))
    sharp = beyond > least
    for jump in np.searchsorted(time, view.elapsed[list(view.jumps)]):
        sharp[max(jump - _BESIDE - 1, 0) : jump + _BESIDE + 1] = False
    places = np.flatnonzero(sharp)
    falls = []
    for run in np.split(places, np.flatnonzero(np.diff(places) > _BESIDE) + 1):
        if not run.size:
            continue
        size, near = float(np.sum(beyond[run])), slice(max(run[0] - _BESIDE, 0), run[-1] + _BESIDE + 1)
        if np.sum(beyond[near]) > _STAYS * size:
            middle = float(np.average(0.5 * (time[run] + time[run + 1]), weights=beyond[run]))
            falls.append(Fall(middle / view.duration, size))
    return tuple(falls)
