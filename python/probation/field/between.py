"""The strain between the samples, where a scheme takes more than one step from each to the next."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.source import Samples


def between(time: FloatArray, strain: Samples, substeps: int, *, smooth: bool) -> tuple[FloatArray, Samples]:
    """Times and strains at every substep: along the cubic spline through smoothed samples, straight through raw ones.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    strain : ndarray, shape (pixels, n_times) [-]

    Returns
    -------
    time : ndarray, shape ((n_times - 1) * substeps + 1,) [s]
    strain : ndarray, shape (pixels, (n_times - 1) * substeps + 1) [-]
    """
    if substeps == 1:
        return time, strain
    from scipy.interpolate import make_interp_spline  # noqa: PLC0415 - slow to load

    within = np.diff(time)[:, None] * (np.arange(substeps) / substeps)
    fine = np.append((time[:-1, None] + within).ravel(), time[-1])
    spline = make_interp_spline(time, np.asarray(strain, dtype=np.float64), k=3 if smooth else 1, axis=1)
    return fine, np.ascontiguousarray(spline(fine))
