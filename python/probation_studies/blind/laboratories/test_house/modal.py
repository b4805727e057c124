"""The law of 50 modes, solved by an exact exponential step for every mode.

s_j' = p_j E eps' - (s_j - p_j R)/(r_j tau), R = G (exp(2 eps) - exp(-eps)). From one instant to the next the strain
rate, tau_max and the slope of R are constant, so that every mode has a closed solution; instants are so close that
this is all the error there is.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

FloatArray: TypeAlias = NDArray[np.float64]
Feedback: TypeAlias = Callable[[int, float, float, float], float]
"""Factor on tau_max of a step: of its number, the stress in its middle [MPa], its duration [s] and rate [1/s]."""

MODES, DECADES = 50, 6.0
RATIOS: FloatArray = 10.0 ** (-np.arange(MODES - 1, -1, -1) * DECADES / (MODES - 1))
"""Relaxation times over tau_max."""
WEIGHTS: FloatArray = np.sqrt(RATIOS) / np.sqrt(RATIOS).sum()
_SLOWEST = 1e-7
"""The least strain rate that a companion relation is given [1/s]."""


def haward_thackray(strain: FloatArray) -> FloatArray:
    """exp(2 eps) - exp(-eps)."""
    return np.asarray(np.exp(2.0 * strain) - np.exp(-strain))


@dataclass(frozen=True)
class Law:
    """Parameters of one specimen.

    Attributes
    ----------
    modulus, hardening : float [MPa]
    alpha : float
        Factor on tau_max.
    companion : tuple of float, optional
        Slope and intercept of tau_max rate = slope log10(rate) + intercept.
    seconds : float
        tau_max where there is no companion relation.
    """

    modulus: float
    alpha: float
    hardening: float
    companion: tuple[float, float] | None
    seconds: float = 0.0

    def tau(self, rate: FloatArray) -> FloatArray:
        """tau_max [s] at strain rates [1/s]."""
        if self.companion is None:
            return np.full(np.shape(rate), self.alpha * self.seconds)
        slope, intercept = self.companion
        speed = np.maximum(np.abs(rate), _SLOWEST)
        return np.asarray(self.alpha * ((slope * np.log10(speed) + intercept) / speed))

    def scaled(self, modulus: float = 1.0, alpha: float = 1.0, hardening: float = 1.0) -> Law:
        """With its parameters times factors."""
        return replace(
            self, modulus=self.modulus * modulus, alpha=self.alpha * alpha, hardening=self.hardening * hardening
        )


def solve(
    time: FloatArray,
    strain: FloatArray,
    tau: FloatArray,
    relaxed: FloatArray,
    modulus: float,
    *,
    ratios: FloatArray = RATIOS,
    weights: FloatArray = WEIGHTS,
    start: FloatArray | None = None,
    feedback: Feedback | None = None,
) -> FloatArray:
    """Stress [MPa] at every instant.

    Parameters
    ----------
    time, strain, relaxed : ndarray, shape (n,)
        [s], true strain, R [MPa].
    tau : ndarray, shape (n - 1,)
        tau_max of every step [s].
    modulus : float [MPa]
    ratios, weights : ndarray, shape (n_modes,)
    start : ndarray, shape (n_modes,), optional
        Stresses of the modes at the first instant; relaxed if left out.
    feedback : callable, optional
    """
    step = np.diff(time)
    rate = np.diff(strain) / step
    modes = np.empty((len(time), len(ratios)))
    modes[0] = weights * relaxed[0] if start is None else start

    def factors(n: slice, factor: float = 1.0) -> tuple[FloatArray, FloatArray]:
        """What is kept of the modes' stresses in some steps, and what is added to them."""
        z = step[n, None] / (tau[n, None] * factor) / ratios
        lost = -np.expm1(-z)
        mean = lost / z
        before, after = relaxed[:-1][n, None], relaxed[1:][n, None]
        loaded = modulus * rate[n, None] * step[n, None] * mean
        return 1.0 - lost, weights * (loaded + after * (1.0 - mean) + before * (mean - (1.0 - lost)))

    if feedback is None:
        keep, add = factors(slice(None))
        for n in range(len(step)):
            modes[n + 1] = keep[n] * modes[n] + add[n]
        return np.asarray(modes.sum(axis=1))
    stress = np.empty(len(time))
    stress[0], slope = modes[0].sum(), modulus * rate[0]
    for n in range(len(step)):
        keep, add = factors(slice(n, n + 1), feedback(n, stress[n] + 0.5 * slope * step[n], step[n], rate[n]))
        modes[n + 1] = keep[0] * modes[n] + add[0]
        stress[n + 1] = modes[n + 1].sum()
        slope = (stress[n + 1] - stress[n]) / step[n]
    return stress


def response_to_strain_error(
    time: FloatArray, strain: FloatArray, tau: FloatArray, modulus: float, hardening: float
) -> FloatArray:
    """What an error of a strain sample does to the stress of the law along straight pieces between samples.

    Parameters
    ----------
    time, strain : ndarray, shape (n,)
    tau : ndarray, shape (n - 1,)
        Does not change with the error.
    modulus, hardening : float [MPa]

    Returns
    -------
    ndarray, shape (n, n) [MPa]
        Stress of instant i by strain of sample k.
    """
    count, step = len(time), np.diff(time)
    slope = hardening * (2.0 * np.exp(2.0 * strain) + np.exp(-strain))  # dR/d eps
    z = step[:, None] / tau[:, None] / RATIOS
    lost = -np.expm1(-z)
    mean = lost / z
    keep, rise = 1.0 - lost, WEIGHTS * modulus * mean
    before, after = WEIGHTS * (mean - keep), WEIGHTS * (1.0 - mean)
    matrix = np.zeros((count, count))
    state = np.zeros((count, MODES))  # of the modes, by samples
    state[0] = WEIGHTS * slope[0]
    matrix[0, 0] = slope[0]
    for i in range(count - 1):
        state[: i + 1] *= keep[i]
        state[i] += before[i] * slope[i] - rise[i]
        state[i + 1] = rise[i] + after[i] * slope[i + 1]
        matrix[i + 1, : i + 2] = state[: i + 2].sum(axis=1)
    return matrix
