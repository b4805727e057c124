"""White coordinates where more noise comes beside what is white already."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def joint_directions(more: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Q (n, k) and shrink (k,) with (I + U U^T)^(-1/2) = I - Q diag(shrink) Q^T for noise U of shape (n, m)."""
    directions, size, _ = np.linalg.svd(more, full_matrices=False)
    seen = size > 3e-5 * max(float(size.max(initial=0.0)), 1e-300)
    return directions[:, seen], 1.0 - 1.0 / np.sqrt(1.0 + size[seen] ** 2)


def jointly_whitened(more: FloatArray, values: FloatArray) -> FloatArray:
    """(I + U U^T)^(-1/2) times columns (n,) or (n, m), U the noise that comes beside, shape (n, k)."""
    directions, shrink = joint_directions(more)
    along = directions.T @ values
    return np.asarray(values - directions @ (along * (shrink if values.ndim == 1 else shrink[:, None])))
