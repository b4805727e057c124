"""A Maxwell element of unit modulus along any sampled history, exact between samples."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation import _core

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def maxwell_element(time: FloatArray, values: FloatArray, relaxation_time: float) -> FloatArray:
    r"""Solve :math:`y' = v' - y/\tau`, y(0) = 0, for piecewise-linear v; shape (n,).

    v - y is v seen through a first-order lag of time constant :math:`\tau`.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
    values : ndarray, shape (n,)
    relaxation_time : float [s]
        Positive.
    """
    moved = values - values[0]
    size = float(np.max(np.abs(moved))) or 1.0  # the engine takes strains: any other quantity may be far larger
    law = _core.Law(1.0, 0.0, relaxation_time, 1.0, None, _one_mode())
    found = np.empty(len(time))
    solver = _core.Solver(_core.History(time, moved / size), _core.Scheme.sa2)
    solver.stress(law, _core.LawChange(), found)
    return size * found


@lru_cache(maxsize=1)
def _one_mode() -> _core.Spectrum:
    return _core.Spectrum(np.ones(1), np.ones(1))
