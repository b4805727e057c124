"""The base law, integrated exactly per mode for a strain that is linear within each step.

d(sigma_j)/dt = p_j E deps/dt - (sigma_j - p_j R)/tau_j, with tau_j = r_j tau_max, p_j proportional to sqrt(r_j). Over
a step the relaxed stress R is the parabola through its values at both ends and in the middle, so that with z = h/tau_j
and the moments m0 = 1 - exp(-z), m1 = 1 - m0/z, m2 = 1 - 2 m1/z nothing but R's third derivative is neglected.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Sequence

FloatArray: TypeAlias = NDArray[np.float64]

MODES, DECADES = 50, 6.0
RATIO: FloatArray = 10.0 ** (-DECADES * np.arange(MODES - 1, -1, -1) / (MODES - 1))
"""Relaxation times over the longest one."""
WEIGHT: FloatArray = np.sqrt(RATIO) / np.sum(np.sqrt(RATIO))
LEAST_RATE = 1e-6
"""Of the companion relation [1/s]."""


def haward_thackray(strain: FloatArray) -> FloatArray:
    """exp(2 eps) - exp(-eps)."""
    return np.asarray(np.exp(2.0 * strain) - np.exp(-strain))


@dataclass(frozen=True)
class Material:
    """Parameters of the base law.

    Attributes
    ----------
    modulus, hardening : float [MPa]
    time : float
        tau_max [s], or alpha where there is a companion relation.
    companion : tuple of float, optional
        Slope and intercept of tau_max rate = slope log10(rate) + intercept.
    """

    modulus: float
    time: float
    hardening: float
    companion: tuple[float, float] | None = None

    def log_time(self, rate: FloatArray) -> FloatArray:
        """Natural logarithm of tau_max [s] at strain rates [1/s]."""
        if self.companion is None:
            return np.full(np.shape(rate), np.log(self.time))
        slope, intercept = self.companion
        least = np.maximum(np.abs(rate), LEAST_RATE)
        return np.asarray(np.log(self.time * (slope * np.log10(least) + intercept) / least))


class Feedback(Protocol):
    """What the stress does to the relaxation times while the specimen is integrated."""

    def shift(self, stress: float, overstress: float, strain_step: float, time_step: float) -> float:
        """Of the logarithm of tau_max over this step; called once per step, in order."""


@dataclass(frozen=True, eq=False)
class Course:
    """What a specimen goes through, on n instants.

    Attributes
    ----------
    strain : ndarray, shape (n,)
    log_time : ndarray, shape (n - 1,)
        Logarithm of tau_max [s] over every step.
    relaxed : ndarray, shape (2 n - 1,) [MPa]
        Relaxed stress at the instants and between them.
    modulus : ndarray, shape (n - 1,) [MPa]
    weight : ndarray, shape (50,)
    start : ndarray, shape (50,) [MPa]
        Modal stresses above the relaxed ones.
    feedbacks : tuple of Feedback
    """

    strain: FloatArray
    log_time: FloatArray
    relaxed: FloatArray
    modulus: FloatArray
    weight: FloatArray
    start: FloatArray
    feedbacks: tuple[Feedback, ...] = ()


def halved(values: FloatArray) -> FloatArray:
    """Values at the instants and, linear between them, in the middle of every step; shape (2 n - 1,)."""
    out = np.empty(2 * len(values) - 1)
    out[::2] = values
    out[1::2] = 0.5 * (values[1:] + values[:-1])
    return out


def base_course(material: Material, time: FloatArray, strain: FloatArray) -> Course:
    """What the base law says of a strain history."""
    return Course(
        strain=strain,
        log_time=material.log_time(np.diff(strain) / np.diff(time)),
        relaxed=material.hardening * haward_thackray(halved(strain)),
        modulus=np.full(len(time) - 1, material.modulus),
        weight=WEIGHT,
        start=np.zeros(MODES),
    )


def integrate(time: FloatArray, courses: Sequence[Course]) -> FloatArray:
    """Stress [MPa] of several courses over the same instants, shape (n_courses, n_times).

    Feedbacks see the stress in the middle of a step, extrapolated from the two instants before.
    """
    step = np.diff(time)
    log_time = np.array([each.log_time for each in courses])
    weight = np.array([each.weight for each in courses])
    relaxed = np.array([each.relaxed for each in courses])
    first, middle, last = relaxed[:, :-1:2], relaxed[:, 1::2], relaxed[:, 2::2]
    slope, bend = 4.0 * middle - 3.0 * first - last, 2.0 * (first + last) - 4.0 * middle
    strain_step = np.array([np.diff(each.strain) for each in courses])
    driven = strain_step * np.array([each.modulus for each in courses])
    modal = weight * relaxed[:, :1] + np.array([each.start for each in courses])
    fed = [(k, feedback) for k, each in enumerate(courses) for feedback in each.feedbacks]
    stress = np.empty((len(courses), len(time)))
    stress[:, 0] = modal.sum(axis=1)
    log_ratio = np.log(RATIO)
    for n, h in enumerate(step):
        log_time_now = log_time[:, n].copy()
        for k, feedback in fed:
            before = stress[k, n]
            expected = before + 0.5 * (before - stress[k, n - 1]) if n else before
            over = expected - middle[k, n]
            log_time_now[k] += feedback.shift(expected, over, float(strain_step[k, n]), float(h))
        z = np.exp(np.log(h) - log_time_now[:, None] - log_ratio)
        m0 = -np.expm1(-z)
        mean = m0 / z
        m1 = 1.0 - mean
        m2 = 1.0 - 2.0 * m1 / z
        sources = driven[:, n, None] * mean + first[:, n, None] * m0 + slope[:, n, None] * m1 + bend[:, n, None] * m2
        modal += weight * sources - m0 * modal
        stress[:, n + 1] = modal.sum(axis=1)
    return stress
