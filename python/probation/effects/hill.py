"""A smooth step about a value (Hill 1910): what sets in about a strain."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray

NOTHING = 1e-9
"""Value over that of the middle which stands for none: nothing has set in there, and its power is finite."""


def hill(values: FloatArray, middle: float, abruptness: float) -> FloatArray:
    """v^m / (v^m + v_c^m), v not below 0; shape (n,).

    Parameters
    ----------
    values : ndarray, shape (n,)
    middle : float
        v_c, where half has set in, in the values' unit.
    abruptness : float
        m [-].
    """
    part = np.maximum(values / middle, NOTHING)
    return np.asarray(1.0 / (1.0 + part**-abruptness))
