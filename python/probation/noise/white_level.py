"""White stress noise jointly with propagated strain noise: size by restricted maximum likelihood (Harville 1977)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.noise.joint_noise import joint_root
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray

LOG_LEVEL_TOLERANCE = 0.01
"""Of the level's logarithm: small against its standard error."""


def white_level(residual: FloatArray, tangent: FloatArray, propagated: FloatArray | None, known: float) -> float:
    """Standard deviation of the white part of a residual [MPa].

    Parameters
    ----------
    residual : ndarray, shape (n,) [MPa]
    tangent : ndarray, shape (n, p)
        What a fit has taken out of the residual.
    propagated : ndarray, shape (n, k), or None
        Strain noise as stress [MPa], whose size is known.
    known : float
        About the level [MPa]: where the search begins.
    """
    size = np.linalg.norm(tangent, axis=0)
    columns = np.column_stack([tangent / np.where(size > 0.0, size, 1.0), residual])
    count, free = tangent.shape
    rms = float(np.sqrt(residual @ residual / max(count - free, 1)))
    if propagated is None or not propagated.shape[1]:
        return rms

    def criterion(log_level: float) -> float:
        level = float(np.exp(log_level))
        root = joint_root(propagated / level)
        triangle = np.abs(np.diag(np.linalg.qr(root.whiten(columns) / level, mode="r")))
        within = 2.0 * float(np.log(np.maximum(triangle[:free], 1e-300)).sum())
        return float(2.0 * count * log_level + root.log_determinant + within + triangle[free] ** 2)

    least, most = NOISE.level_range
    ends = np.log(least * min(known, max(rms, 1e-300))), np.log(most * max(known, rms))
    from scipy.optimize import minimize_scalar  # noqa: PLC0415 - slow to load; only noise of the strain needs it

    minimum = minimize_scalar(criterion, bounds=ends, method="bounded", options={"xatol": LOG_LEVEL_TOLERANCE})
    return float(np.exp(minimum.x))
