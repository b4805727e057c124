"""Between samples: a strain history at more instants, and how many of them a scheme needs.

The samples stand for straight lines or for cubics.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray


def fine_time(time: FloatArray, substeps: int) -> FloatArray:
    """`substeps` times as many instants, shape (n_steps * substeps + 1,) [s]; the samples are every n-th of them."""
    within = np.diff(time)[:, None] * (np.arange(substeps) / substeps)
    return _spread(time[:-1, None] + within, time[-1:])


def refine(
    time: FloatArray,
    substeps: int,
    strain: FloatArray,
    rate: FloatArray | None,
    begin: FloatArray | None,
    end: FloatArray | None,
) -> tuple[FloatArray, FloatArray | None]:
    """Strain and rate at `substeps` times as many instants: a straight line, or the cubic through strain and rate.

    Linear in strain, rate and the rates at which each step begins and ends, all with the instants or steps as their
    first axis.
    """
    more = (None,) * (strain.ndim - 1)
    part = (np.arange(substeps) / substeps)[(None, slice(None), *more)]
    step = np.diff(time)[(slice(None), None, *more)]
    rise = np.diff(strain, axis=0)[:, None]
    fine = strain[:-1, None] + rise * part
    if rate is None or begin is None or end is None:
        return _spread(fine, strain[-1:]), None
    begin, end = begin[:, None], end[:, None]
    bend = (1.0 - part) * (step * begin - rise) + part * (rise - step * end)
    fine = fine + part * (1.0 - part) * bend
    slope = (rise + (1.0 - 2.0 * part) * bend + part * (1.0 - part) * (2.0 * rise - step * (begin + end))) / step
    slope[:, 0] = rate[:-1]
    return _spread(fine, strain[-1:]), _spread(slope, rate[-1:])


def fewest_substeps(error_with: Callable[[int], float], tolerated: float, first: int, most: int) -> int:
    """Steps from sample to sample, from `first` to `most`, that leave a scheme of order 2 no more than `tolerated`.

    Parameters
    ----------
    error_with : callable
        The error with so many steps, in the unit of `tolerated`. The first time would tell, were the steps always short
        enough for the order to show.
    """
    steps = first
    while steps < most:
        ratio = min(error_with(steps) / tolerated, 1e6)
        if ratio <= 1.0:
            break
        steps = min(max(int(np.ceil(steps * np.sqrt(ratio))), steps + 1), most)
    return steps


def _spread(rows: FloatArray, last: FloatArray) -> FloatArray:
    """Instants within steps, (n_steps, substeps, ...), as one axis, with the last instant of all."""
    return np.concatenate([rows.reshape(-1, *rows.shape[2:]), last])
