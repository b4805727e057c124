"""Strain histories of many pixels without their noise: smoothing splines whose stiffness each record chooses.

Noise of the strain enters the law's own answer, and least squares take that for a softer material: on the example, far
from the neck, the unrelaxed modulus comes out a quarter too low. The residual cannot tell.
"""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation.field.samples import bridged
from probation.settings.field import FIELD
from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.samples import BoolArray
    from probation.field.source import Samples


def smoothed(time: FloatArray, strain: Samples) -> FloatArray:
    """Each record by the spline of least generalised cross-validation.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
        Increasing; more than `FIELD.penalised_derivative`.
    strain : ndarray, shape (pixels, n_times) [-]
        Finite.

    Returns
    -------
    ndarray, shape (pixels, n_times) [-]
    """
    roughness, shapes = _shapes(time.tobytes())
    first, last = FIELD.stiffness_exponents
    stiffness = 10.0 ** np.arange(first, last + 0.5 * FIELD.stiffness_step, FIELD.stiffness_step)
    kept = 1.0 / (1.0 + stiffness[:, None] * roughness)  # of each shape, by stiffness
    parts = strain.astype(np.float64) @ shapes
    left = parts**2 @ ((1.0 - kept) ** 2).T
    freedom = 1.0 - SMOOTHING.prudence * kept.sum(axis=1) / len(time)
    score = np.where(freedom > 0.0, left / np.maximum(freedom, 1e-9) ** 2, np.inf)
    return np.asarray((parts * kept[np.argmin(score, axis=1)]) @ shapes.T)


def smoothed_records(time: FloatArray, strain: Samples, used: BoolArray) -> FloatArray:
    """Records with gaps and of several lengths, shape (pixels, n_times); what is not in use is NaN.

    Short gaps are bridged straight, so that pixels of the same length share their shapes.
    """
    found: FloatArray = np.full(strain.shape, np.nan)
    for pixels, samples, values in bridged(time, strain, used):
        if np.count_nonzero(samples) > FIELD.penalised_derivative:
            found[np.ix_(pixels, samples)] = smoothed(time[samples], values)
    found[~used] = np.nan
    return found


@lru_cache(maxsize=64)
def _shapes(instants: bytes) -> tuple[FloatArray, FloatArray]:
    """Shapes (n_times, n_times), each a column, and the roughness of each (n_times,)."""
    time = np.frombuffer(instants)
    time = time / np.median(np.diff(time))
    bent = np.eye(len(time))
    for order in range(1, FIELD.penalised_derivative + 1):  # divided differences, again and again
        bent = order * np.diff(bent, axis=0) / (time[order:] - time[:-order])[:, None]
    spans = (time[FIELD.penalised_derivative :] - time[: -FIELD.penalised_derivative]) / FIELD.penalised_derivative
    # Of the root, for the smooth shapes' roughness is far below the last digit of the rough ones'.
    size, rows = np.linalg.svd(np.sqrt(spans)[:, None] * bent)[1:]
    return np.concatenate([size**2, np.zeros(FIELD.penalised_derivative)]), np.ascontiguousarray(rows.T)
