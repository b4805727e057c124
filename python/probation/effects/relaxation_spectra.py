"""Distributions of relaxation times that are usual for polymers: which part of the modulus has times up to t."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray

_ANGLES = (np.arange(64) + 0.5) * (np.pi / 64)
"""Where Zolotarev's integral over an angle from 0 to pi is summed up: it is smooth, and flat at both ends."""


def cole_cole(ratio: FloatArray, exponent: float) -> FloatArray:
    """Of a relaxation E_a(-(t / t_0)^a), a fractional Maxwell element; shape (n,).

    The integral of the density sin(pi a) / (2 pi (cosh(a ln r) + cos(pi a))) over ln r (Cole & Cole 1941, J. Chem.
    Phys. 9, 341; Schiessel et al. 1995, J. Phys. A 28, 6567).

    Parameters
    ----------
    ratio : ndarray, shape (n,)
        Times over t_0.
    exponent : float
        a, between 0 and 1; 1 is a single time.
    """
    rise = np.tan(0.5 * np.pi * exponent) * np.tanh(0.5 * exponent * np.log(ratio))
    return np.asarray(0.5 + np.arctan(rise) / (np.pi * exponent))


def stretched_exponential(ratio: FloatArray, exponent: float) -> FloatArray:
    """Of a relaxation exp(-(t / t_0)^b); shape (n,).

    The rates have Levy's one-sided stable distribution (Pollard 1946, Bull. Am. Math. Soc. 52, 908), here by the
    integral of Zolotarev (1986, One-dimensional Stable Distributions, section 2.2), whose terms are all positive.

    Parameters
    ----------
    ratio : ndarray, shape (n,)
        Times over t_0.
    exponent : float
        b, between 0 and 1; 1 is a single time.
    """
    rest = 1.0 - exponent
    along = np.sin(exponent * _ANGLES) ** exponent * np.sin(rest * _ANGLES) ** rest / np.sin(_ANGLES)
    logarithm = (np.log(along) + exponent * np.log(ratio)[:, None]) / rest
    return np.asarray(-np.mean(np.expm1(-np.exp(np.minimum(logarithm, 50.0))), axis=1))
