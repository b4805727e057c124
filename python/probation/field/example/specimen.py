"""A flat dumbbell that necks between grips: where it is, what it is made of, and how far each point is drawn."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
BoolArray: TypeAlias = NDArray[np.bool_]

VIEW = 12.8  # mm, side of the picture
DURATION = 224.7  # s
_HALF_WIDTH = 5.9  # mm, of the gauge section
_FILLET_FROM, _FILLET_RADIUS = 4.9, 4.0  # mm from the middle where the dumbbell widens, and its fillet
# where the neck forms, grips at 0.08 mm/s: e = b t / (t^c + d e^(a t)).
_A, _C, _D = -0.03445, 0.7055, 221.19
_DRAWN, _UNDRAWN = 1.8, 0.3  # true strain at the end, in the middle of the neck and far from it
_NECK = 2.6  # mm, half-length of the neck


@dataclass(frozen=True)
class Material:
    """What the specimen is made of, point by point.

    Attributes
    ----------
    unrelaxed_modulus, tau_max, hardening_modulus : ndarray, shape (rows, columns) [MPa], [s], [MPa]
    """

    unrelaxed_modulus: FloatArray
    tau_max: FloatArray
    hardening_modulus: FloatArray


def positions(size: int) -> FloatArray:
    """Distance of the pixels of a row or column from the middle of the picture [mm], shape (size,)."""
    return np.asarray((np.arange(size) + 0.5) * VIEW / size - VIEW / 2)


def inside(y: FloatArray, x: FloatArray) -> BoolArray:
    """Whether there is specimen, and no background."""
    into = np.clip(np.abs(y) - _FILLET_FROM, 0.0, _FILLET_RADIUS)
    half_width = _HALF_WIDTH + _FILLET_RADIUS - np.sqrt(_FILLET_RADIUS**2 - into**2)
    return np.asarray(np.abs(x) < half_width)


def material(y: FloatArray, x: FloatArray) -> Material:
    """Crystallinity that rises across the specimen, and an inclusion left of the neck's middle."""
    crystallinity = 0.06 * x / 6.4 + 0.04 * y / 6.4
    inclusion = np.exp(-(((y + 0.8) ** 2 + (x + 2.2) ** 2) / 1.1**2))
    return Material(
        unrelaxed_modulus=3220.0 * (1.0 + crystallinity + 0.10 * inclusion),
        tau_max=5.2 * (1.0 + 1.5 * crystallinity + 0.15 * inclusion),
        hardening_modulus=1.85 * (1.0 - crystallinity - 0.20 * inclusion),
    )


def true_strain(time: FloatArray, y: FloatArray, x: FloatArray) -> FloatArray:
    """Local true strain; the neck starts in the middle, and its shoulders follow later and slower.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
    y, x : ndarray, shape (pixels,) [mm]

    Returns
    -------
    ndarray, shape (pixels, n) [-]
    """
    bowed = y + 0.02 * x**2  # the front of a neck is bent
    neck = np.exp(-((bowed / _NECK) ** 2))[:, None]
    a = _A * (0.65 + 0.35 * neck)
    d = _D * (1.0 + 1.5 * (1.0 - neck))

    def shape(t: FloatArray) -> FloatArray:
        return np.asarray(t / (t**_C + d * np.exp(a * t)))

    end = _UNDRAWN + (_DRAWN - _UNDRAWN) * neck
    return np.asarray(end * shape(time[None, :]) / shape(np.array([[DURATION]])))
