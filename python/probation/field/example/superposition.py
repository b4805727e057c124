"""The modal law at constant tau_max as a superposition integral, by fast Fourier transform.

With X = G e_HT the relaxed stress, sigma(t) = X(t) + int_0^t K(t - s) (E_u e'(s) - X'(s)) ds with the kernel
K(t) = sum p_j e^(-t/tau_j).
On uniform steps with e and X straight in each, the integral is a discrete convolution with the means of K over the
steps. Nothing is stepped through time and nothing is shared with the engine: what it identifies is made another way.
"""

from __future__ import annotations

from functools import cache
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline
from scipy.signal import fftconvolve

FloatArray: TypeAlias = NDArray[np.float64]

MODES, DECADES = 50, 6.0
RATIO: FloatArray = 10.0 ** np.linspace(-DECADES, 0.0, MODES)
"""tau_j / tau_max, shape (modes,)."""
WEIGHT: FloatArray = np.sqrt(RATIO) / np.sqrt(RATIO).sum()
"""p_j, shape (modes,)."""
_FROM, _TO, _KNOTS = 1e-6, 1e6, 2401  # of t / tau_max


def superpose(
    step: float, strain: FloatArray, unrelaxed_modulus: FloatArray, tau_max: FloatArray, hardening_modulus: FloatArray
) -> FloatArray:
    """True stress of many pixels.

    Parameters
    ----------
    step : float [s]
        Between the instants.
    strain : ndarray, shape (pixels, n) [-]
        True strain, from zero.
    unrelaxed_modulus, tau_max, hardening_modulus : ndarray, shape (pixels,) [MPa], [s], [MPa]

    Returns
    -------
    ndarray, shape (pixels, n) [MPa]
    """
    relaxed = hardening_modulus[:, None] * (np.exp(2.0 * strain) - np.exp(-strain))
    drive = unrelaxed_modulus[:, None] * np.diff(strain) - np.diff(relaxed)
    borders = np.arange(strain.shape[1]) * step / tau_max[:, None]
    kernel = np.diff(_integral(borders)) * (tau_max / step)[:, None]
    stress: FloatArray = relaxed.copy()
    stress[:, 1:] += fftconvolve(drive, kernel, axes=1)[:, : drive.shape[1]]
    return stress


def _integral(x: FloatArray) -> FloatArray:
    """The integral of K from 0 to x tau_max, over tau_max."""
    found: FloatArray = np.zeros_like(x)
    beyond = x > _FROM
    found[beyond] = np.exp(_table()(np.log(x[beyond])))
    return found


@cache
def _table() -> CubicSpline:
    """Ln of the integral against ln x, its relative error below 1e-9."""
    x = np.geomspace(_FROM, _TO, _KNOTS)
    return CubicSpline(np.log(x), np.log((-np.expm1(-x[:, None] / RATIO) * RATIO) @ WEIGHT))
