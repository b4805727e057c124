"""What changes within a sample or two, read off a record: its force falls, its strain jumps."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from probation.normal import SD_OF_MEDIAN
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_NEAR = 3
"""Differences before and after, at a distance, between whose medians a difference is usual."""

_BESIDE = 2
"""Samples beside a change in which a spike comes back; nor is a change nearer to a jump of the rate."""

_STAYS = 0.2
"""Part of a change that is there after these samples, at least."""


class Sudden(NamedTuple):
    """Sudden changes of a record.

    Attributes
    ----------
    times : int
        How many there are.
    total : ndarray, shape (n,)
        Of those so far, at the view's instants.
    """

    times: int
    total: FloatArray


@lru_cache(maxsize=64)
def falls_of(view: RecordView) -> Sudden:
    """Sudden falls of the force [MPa of nominal stress, positive]; of the view that has the data."""
    near_jumps = np.zeros(len(view.data) - 1, dtype=np.bool_)
    for jump in np.searchsorted(view.sampled(view.time), view.time[list(view.jumps)]):
        near_jumps[max(jump - _BESIDE - 1, 0) : jump + _BESIDE + 1] = True
    times, changes = _rises(-view.data / view.sampled(view.stretch), near_jumps)
    return Sudden(times, _total(view, changes))


@lru_cache(maxsize=64)
def jumps_of(view: RecordView) -> Sudden:
    """Sudden changes of the recorded strain [-]; of the view that has the data."""
    strain = view.sampled(view.recorded_strain)
    anywhere = np.zeros(len(strain) - 1, dtype=np.bool_)
    (up, rises), (down, falls) = (_rises(values, anywhere) for values in (strain, -strain))
    return Sudden(up + down, _total(view, rises - falls))


def _total(view: RecordView, changes: FloatArray) -> FloatArray:
    return np.asarray(np.interp(view.time, view.sampled(view.time), np.append(0.0, np.cumsum(changes))))


def _rises(values: FloatArray, never: NDArray[np.bool_]) -> tuple[int, FloatArray]:
    """How many sudden rises there are, and what each sample rises by to the next one in them; not where `never`."""
    change = np.diff(values)
    medians = np.median(sliding_window_view(np.pad(change, _NEAR + 1, mode="edge"), _NEAR), axis=1)
    before, after = medians[: len(change)], medians[-len(change) :]
    beyond = change - np.maximum(before, after)
    noise = SD_OF_MEDIAN * float(np.median(np.abs(change - 0.5 * (before + after))))
    least = max(EFFECTS.sudden * noise, EFFECTS.least_sudden * float(np.max(np.abs(values))))
    places = np.flatnonzero((beyond > least) & ~never)
    times, rises = 0, np.zeros(len(change))
    for run in np.split(places, np.flatnonzero(np.diff(places) > _BESIDE) + 1):
        if not run.size:
            continue
        near = slice(max(run[0] - _BESIDE, 0), run[-1] + _BESIDE + 1)
        if np.sum(beyond[near]) > _STAYS * np.sum(beyond[run]):
            times += 1
            rises[run] = beyond[run]
    return times, rises
