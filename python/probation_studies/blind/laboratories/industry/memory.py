"""The law as one Volterra integral in reduced time, solved by product integration.

With xi = int dt / tau_max, modes r_j and weights p_j, eq. (6) of the paper with a relaxed start is

    sigma(t) = R(t) + int_0^xi K(xi - xi') (E_u d eps - dR),   K(x) = sum_j p_j exp(-x / r_j),   R = G eps_HT,

so that one memory function K holds the spectrum. Strain and relaxed stress are straight in xi between nodes; only
the integral of the memory, L(x) = int_0^x K, is needed, from a table. No mode is ever stepped through time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np

FloatArray: TypeAlias = "np.ndarray"

_LOW, _HIGH, _POINTS = np.log(1e-9), np.log(1e7), 2**15
_STEP = (_HIGH - _LOW) / (_POINTS - 1)
_GRID = np.exp(np.linspace(_LOW, _HIGH, _POINTS))

RATIO = 10.0 ** (-np.arange(50)[::-1] * 6.0 / 49.0)
"""tau_j / tau_max, eq. (4) with N = 50 and d = 6."""
SHARE = np.sqrt(RATIO) / np.sqrt(RATIO).sum()
"""p_j, eq. (5)."""


@dataclass(frozen=True, eq=False)
class Memory:
    """A memory function by its integral on a logarithmic table; the error of a reading is 1.5e-7 of L.

    Attributes
    ----------
    integral : ndarray, shape (n_points,)
        L at the points of the table.
    """

    integral: FloatArray

    @staticmethod
    def of_modes(ratio: FloatArray, share: FloatArray) -> Memory:
        """Of a discrete spectrum."""
        table = np.zeros(_POINTS)
        for r, p in zip(ratio, share, strict=True):
            table -= p * r * np.expm1(-_GRID / r)
        return Memory(table)

    @staticmethod
    def of_function(values: FloatArray) -> Memory:
        """Of K at the points of the table, K = 1 before the first."""
        inside = 0.5 * (values[1:] + values[:-1]) * np.diff(_GRID)
        return Memory(_GRID[0] + np.concatenate([[0.0], np.cumsum(inside)]))

    def mixed(self, other: Memory, part: float) -> Memory:
        """(1 - part) of this one and `part` of the other."""
        return Memory((1.0 - part) * self.integral + part * other.integral)

    def read(self, x: FloatArray) -> FloatArray:
        """L(x); x K(0) below the table, constant beyond it."""
        place = (np.log(np.maximum(x, _GRID[0])) - _LOW) / _STEP
        np.minimum(place, _POINTS - 1.001, out=place)
        below = place.astype(np.int32)
        place -= below
        low = self.integral[below]
        found = low + place * (self.integral[below + 1] - low)
        return np.asarray(np.where(x < _GRID[0], np.maximum(x, 0.0), found))

    def operator(self, reduced: FloatArray) -> FloatArray:
        """Weights of the increments of E_u eps - R in the stress.

        Parameters
        ----------
        reduced : ndarray, shape (n_nodes,)
            xi, growing.

        Returns
        -------
        ndarray, shape (n_nodes, n_nodes - 1)
            Zero above the diagonal.
        """
        since = reduced[:, None] - reduced[None, :]
        past = np.tril(self.read(since), -1)
        return np.asarray((past[:, :-1] - past[:, 1:]) / np.diff(reduced)[None, :])


SQUARE_ROOT = Memory.of_modes(RATIO, SHARE)
"""The memory of the base law."""

TABLE = _GRID
"""x at the points of a memory's table."""


def haward_thackray(strain: FloatArray) -> FloatArray:
    """lambda^2 - 1 / lambda of a true strain."""
    return np.asarray(np.exp(2.0 * strain) - np.exp(-strain))
