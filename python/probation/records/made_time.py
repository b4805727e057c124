"""Time for a curve that has none: the strain, or the displacement, is taken to go at a stated rate."""

import re
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted
from probation.errors import InputError
from probation.limits import LARGEST, SMALLEST_PARAMETER
from probation.records.units import convert, measures

FloatArray = NDArray[np.float64]

_RATE = re.compile(r"\s*([+]?[\d.]+(?:[eE][+-]?\d+)?)\s*(\S.*?)\s*")


def parse_rate(path: Path, text: str) -> tuple[float, bool]:
    """A rate such as ``0.001 1/s`` or ``2 mm/min``.

    Returns
    -------
    (float, bool)
        In 1/s, or in mm/s where it is a speed; and whether it is one.

    Raises
    ------
    InputError
        If it is neither, or not positive.
    """
    match = _RATE.fullmatch(text)
    if match is not None:
        for unit, is_speed in (("1/s", False), ("mm/s", True)):
            try:
                value = (
                    float(convert(np.array([float(match[1])]), match[2], unit)[0]) if measures(match[2], unit) else 0
                )
            except ValueError:
                break
            if SMALLEST_PARAMETER <= value <= LARGEST["strain_rate"]:
                return value, is_speed
    raise InputError(
        f"{path}: test_rate: found {quoted(text)}, expected a positive number with a unit, "
        "such as 0.001 1/s or 2 mm/min"
    )


def time_along(measure: FloatArray, rate: float) -> FloatArray:
    """Time at which each sample was taken, if the measure went at that rate, forth and back.

    Parameters
    ----------
    measure : ndarray, shape (n,) [-] or [mm]
        Strain as the file has it, or displacement.
    rate : float [1/s] or [mm/s]

    Returns
    -------
    ndarray, shape (n,) [s]
        From zero; the same twice where the measure stands still.
    """
    return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(measure)))]) / rate
