"""White coordinates jointly with noise that comes on top of what is white already."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky, solve_triangular

if TYPE_CHECKING:
    from probation._arrays import FloatArray

LEAST_SEEN = 3e-5
"""Size of a direction of noise over the largest one's below which it is left out."""


def joint_directions(more: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Q (n, k) and shrink (k,) with (I + U U^T)^(-1/2) = I - Q diag(shrink) Q^T, U (n, m).

    U is all noise beyond the white one, in white coordinates: L [A D S] of docs/diagnosis-method.md, section 1.
    """
    wide = more.shape[0] < more.shape[1]
    variance, vectors = np.linalg.eigh(more @ more.T if wide else more.T @ more)
    # A tenth of the time of singular values; their squares keep seven digits of what is kept here.
    seen = variance > LEAST_SEEN**2 * max(float(variance.max(initial=0.0)), 1e-300)
    variance, vectors = variance[seen], vectors[:, seen]
    directions = vectors if wide else more @ (vectors / np.sqrt(variance))
    return directions, 1.0 - 1.0 / np.sqrt(1.0 + variance)


def jointly_whitened(more: FloatArray, values: FloatArray) -> FloatArray:
    """(I + U U^T)^(-1/2) times columns (n,) or (n, m), U the noise on top, shape (n, k)."""
    return FewRoot(more).whiten(values)


def joint_root(more: FloatArray) -> FewRoot | FullRoot:
    """W with W^T W = (I + U U^T)^-1, for noise U (n, k) on top of white noise: by few directions, or Cholesky's."""
    return FewRoot(more) if 3 * more.shape[1] < len(more) else FullRoot(more)


class FewRoot:
    """Symmetric: I - Q diag(shrink) Q^T.

    Attributes
    ----------
    directions : ndarray, shape (n, k)
    shrink : ndarray, shape (k,)
    log_determinant : float
        Of I + U U^T.
    """

    def __init__(self, more: FloatArray) -> None:
        self.directions, self.shrink = joint_directions(more)
        self.log_determinant = -2.0 * float(np.log1p(-self.shrink).sum())

    def whiten(self, values: FloatArray) -> FloatArray:
        """W times columns (n,) or (n, m)."""
        if not self.shrink.size:
            return values
        along = self.directions.T @ values
        return np.asarray(
            values - self.directions @ (along * (self.shrink if values.ndim == 1 else self.shrink[:, None]))
        )

    whiten_transposed = whiten


class FullRoot:
    """Lower triangular, so that samples keep their order: U has about as many columns as rows."""

    def __init__(self, more: FloatArray) -> None:
        matrix = more @ more.T
        diagonal = np.diag_indices_from(matrix)
        # With errors of 1e8 times the noise, 1 is lost in rounding.
        matrix[diagonal] += 1.0 + len(matrix) * np.finfo(np.float64).eps * float(matrix[diagonal].max(initial=0.0))
        self.factor = cholesky(matrix, lower=True, overwrite_a=True, check_finite=False)
        self.log_determinant = 2.0 * float(np.log(np.diag(self.factor)).sum())

    def whiten(self, values: FloatArray) -> FloatArray:
        """W times columns (n,) or (n, m)."""
        return np.asarray(solve_triangular(self.factor, values, lower=True, check_finite=False))

    def whiten_transposed(self, values: FloatArray) -> FloatArray:
        """W^T times the same."""
        return np.asarray(solve_triangular(self.factor, values, lower=True, trans="T", check_finite=False))
