"""What rises within a sample or two, beyond what it does before and after."""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.lib.stride_tricks import sliding_window_view

from probation.normal import SD_OF_MEDIAN
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray

NEAR = 4
"""Samples within which a dropout comes back; also how near to a jump of the strain rate no fall of the force counts."""

_BESIDE = 3
"""Differences before and after, as far away, whose medians are usual there."""

_STAYS = 0.2
"""Part of a rise that must be left after these samples."""


class Sudden(NamedTuple):
    """Sudden changes along a record.

    Attributes
    ----------
    times : int
        How many there are.
    total : ndarray, shape (n,)
        Sum of those so far.
    """

    times: int
    total: FloatArray


def sudden_rises(values: FloatArray, step: float, never: NDArray[np.bool_] | None = None) -> Sudden:
    """Rises of samples (n,) that noise, or the step of the readings, does not make.

    Parameters
    ----------
    values : ndarray, shape (n,)
    step : float
        Of the readings; 0 where they have none.
    never : ndarray of bool, shape (n - 1,), optional
        Between which samples none counts.
    """
    change = np.diff(values)
    medians = np.median(sliding_window_view(np.pad(change, _BESIDE + 1, mode="edge"), _BESIDE), axis=1)
    before, after = medians[: len(change)], medians[-len(change) :]
    beyond = change - np.maximum(before, after)
    noise = SD_OF_MEDIAN * float(np.median(np.abs(change - 0.5 * (before + after))))
    usual = max(EFFECTS.sudden * noise, EFFECTS.sudden_steps * step)
    least = max(usual, EFFECTS.least_sudden * float(np.max(np.abs(values))))
    places = np.flatnonzero((beyond > least) if never is None else (beyond > least) & ~never)
    times, rises = 0, np.zeros(len(change))
    for run in np.split(places, np.flatnonzero(np.diff(places) > NEAR) + 1):
        if run.size:
            near = slice(max(run[0] - NEAR, 0), run[-1] + NEAR + 1)
            if np.sum(beyond[near]) > _STAYS * np.sum(beyond[run]):
                times += 1
                rises[run] = beyond[run]
    return Sudden(times, np.append(0.0, np.cumsum(rises)))
