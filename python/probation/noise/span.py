"""What columns span, and what noise along them takes off the rest."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray

DEPENDENT = 1e-9
"""Relative singular value below which a direction is taken as none."""

HARDLY_NEW = 1e-4
"""Part of a column that those before it leave, below which it adds nothing to a basis that is built in order."""


def span_of(columns: FloatArray) -> FloatArray:
    """Orthonormal basis of what columns (n, m) span, each counted at the same length; shape (n, rank)."""
    size = np.linalg.norm(columns, axis=0)
    left, upper = np.linalg.qr(columns / np.where(size > 0.0, size, 1.0))
    turned, singular, _ = np.linalg.svd(upper)
    seen = singular > DEPENDENT * max(float(np.max(singular, initial=0.0)), 1e-300)
    return np.asarray(left @ turned[:, seen], dtype=np.float64)


def orthonormal(columns: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Orthonormal columns in the given order, and which there are: one that hangs on those before it is left out."""
    size = np.linalg.norm(columns, axis=0)
    left, upper = np.linalg.qr(columns / np.where(size > 0.0, size, 1.0))
    kept = np.abs(np.diag(upper)) > HARDLY_NEW
    return np.asarray(left[:, kept], dtype=np.float64), kept


def without(columns: FloatArray, span: FloatArray) -> FloatArray:
    """Columns (n,) or (n, m) with an orthonormal basis (n, p) projected out."""
    return np.asarray(columns - span @ (span.T @ columns), dtype=np.float64)
