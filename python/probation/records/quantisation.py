"""The step of a reading's digits, found in the data's own grid."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def quantisation_step(values: FloatArray) -> float:
    """Step of the grid that all values lie on; 0 where there is none.

    The smallest distance between two different values is a first guess; it is refined on ever longer distances, and
    must then hold for all of them. Rounded digits of a text file are such a grid too, mostly a harmless one.

    Parameters
    ----------
    values : ndarray, shape (n,)

    Returns
    -------
    float [as the values]
    """
    distinct = np.unique(values)
    if len(distinct) < NOISE.fewest_values:
        return 0.0
    gaps = np.diff(distinct)
    gaps = gaps[gaps > 1e-9 * float(np.ptp(values))]
    if gaps.size < NOISE.fewest_values - 1:
        return 0.0
    step = float(gaps.min())
    reach = distinct - distinct[0]
    for limit in (4.0, 16.0, 64.0, 256.0, 1024.0, 4096.0, np.inf):  # a small error of the step grows with the distance
        near = reach[(reach <= limit * step) & (reach > 0.5 * step)]  # nearer ones differ by rounding
        if near.size == 0:
            continue
        steps = np.round(near / step)
        step = float(near @ steps / (steps @ steps))
        away = near / step - np.round(near / step)
        if np.sqrt(np.mean(away**2)) > NOISE.on_grid:
            return 0.0
    return step


def quantisation_noise(step: float) -> float:
    """Standard deviation of rounding to a grid, step/sqrt(12) (Widrow)."""
    return step / float(np.sqrt(12.0))
