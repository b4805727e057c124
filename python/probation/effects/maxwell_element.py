"""A Maxwell element of unit modulus along any sampled history, in time or in strain, exact between samples."""

from __future__ import annotations

from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation import _core

if TYPE_CHECKING:
    from probation._arrays import FloatArray

LONGEST = 100.0
"""Relaxation strains that are summed up at once."""


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
    response = np.empty(len(time))
    solver = _core.Solver(_core.History(time, moved / size), _core.Scheme.sa2)
    solver.stress(law, _core.LawChange(), response)
    return size * response


def maxwell_element_in_strain(strain: FloatArray, values: FloatArray, relaxation_strain: float) -> FloatArray:
    r"""Solve :math:`dy = dv - y\,d\varepsilon/\varepsilon_c`, y(0) = 0, for v that is linear in the strain; shape (n,).

    The evolution of a back stress by Armstrong and Frederick, along a strain that never decreases. Where it stands
    still, y follows v.

    Parameters
    ----------
    strain : ndarray, shape (n,)
        Such as the largest so far.
    values : ndarray, shape (n,)
    relaxation_strain : float
        Positive.
    """
    way = (strain - strain[0]) / relaxation_strain
    steps = np.diff(way)
    kept = np.divide(-np.expm1(-steps), steps, out=np.ones_like(steps), where=steps > 0.0)
    response = np.zeros(len(values))
    # y_n = sum of kept_i dv_i e^(way_i - way_n): in blocks, since e^way may exceed all numbers.
    begin = 0
    while begin < len(steps):
        end = max(int(np.searchsorted(way, way[begin] + LONGEST, side="right")) - 1, begin + 1)
        grown = np.exp(np.minimum(way[begin : end + 1] - way[begin], 2.0 * LONGEST))
        added = np.cumsum(kept[begin:end] * np.diff(values)[begin:end] * grown[1:])
        response[begin + 1 : end + 1] = (response[begin] + added) / grown[1:]
        begin = end
    return response


@lru_cache(maxsize=1)
def _one_mode() -> _core.Spectrum:
    return _core.Spectrum(np.ones(1), np.ones(1))
