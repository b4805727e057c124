"""Errors of measurement: those of the video extensometer, through the law, and those of the load cell."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import toeplitz
from scipy.signal import lfilter

from probation_studies.blind.laboratories.university.modal_law import RATIO, WEIGHT

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray, Material


@dataclass(frozen=True)
class Errors:
    """How a campaign is measured.

    Attributes
    ----------
    stress : float [MPa]
        Standard deviation of all that the force channel adds.
    correlated : float
        Part of its variance that is autoregressive.
    correlation : float
        From one sample to the next.
    quantum : float [MPa]
    strain : float
        Standard deviation of one picture's strain; the first picture's, too.
    window : int
        Pictures that the extensometer averages.
    """

    stress: float
    correlated: float
    correlation: float
    quantum: float
    strain: float
    window: int

    def stress_covariance(self, n: int) -> FloatArray:
        """Of the force channel, shape (n, n) [MPa^2]."""
        lag = np.arange(n)
        column = self.correlated * self.stress**2 * self.correlation**lag
        column[0] += (1.0 - self.correlated) * self.stress**2 + self.quantum**2 / 12.0
        return np.asarray(toeplitz(column))

    def averaging(self, n: int) -> FloatArray:
        """Weights of the pictures in every strain sample, shape (n, n); fewer at the ends."""
        half, at = self.window // 2, np.arange(n)
        near = np.abs(at[:, None] - at) <= np.minimum(half, np.minimum(at, n - 1 - at))[:, None]
        return np.asarray(near / near.sum(axis=1, keepdims=True))

    def draw_stress(self, random: Generator, n: int) -> FloatArray:
        """Errors of the force channel but for its steps [MPa]."""
        white = np.sqrt(1.0 - self.correlated) * self.stress * random.standard_normal(n)
        slow = np.sqrt(self.correlated) * self.stress * random.standard_normal(n)
        slow[1:] *= np.sqrt(1.0 - self.correlation**2)
        return np.asarray(white + lfilter([1.0], [1.0, -self.correlation], slow))

    def covariance(self, response: FloatArray) -> FloatArray:
        """Of the recorded stress less the law's along the recorded strain [MPa^2]."""
        carried = self.strain * response @ self.averaging(len(response))
        return np.asarray(self.stress_covariance(len(response)) + carried @ carried.T)


def draw_errors(random: Generator) -> Errors:
    """Strain 1e-5 to 1e-3, half of it averaged; stress 0.02 to 0.08 MPa."""
    return Errors(
        stress=random.uniform(0.02, 0.08),
        correlated=random.uniform(0.0, 0.6) if random.uniform() < 0.7 else 0.0,
        correlation=random.uniform(0.2, 0.7),
        quantum=random.uniform(0.005, 0.05),
        strain=float(10.0 ** random.uniform(-5.0, -3.0)),
        window=int(random.choice([1, 1, 3, 5, 9])),
    )


def strain_response(material: Material, time: FloatArray, strain: FloatArray) -> FloatArray:
    """d(stress)/d(strain sample) [MPa], shape (n, n), of the relaxation function in reduced time.

    A sample's error is a hat between its neighbours. The network's part, some per cent of the modulus, is left out.
    """
    step = np.diff(time)
    reduced = np.concatenate([[0.0], np.cumsum(step / np.exp(material.log_time(np.diff(strain) / step)))])
    grid = np.concatenate([[0.0], np.logspace(-8.0, np.log10(reduced[-1] + 1.0), 8000)])
    remaining = (WEIGHT * RATIO) @ np.exp(-grid / RATIO[:, None])  # relaxation function, integrated to infinity
    between = np.interp(np.maximum(reduced[:, None] - reduced, 0.0), grid, remaining)
    mean = np.tril(material.modulus * np.diff(between, axis=1) / np.diff(reduced), -1)  # over every step
    response = np.zeros((len(time), len(time)))
    response[:, 1:] += mean
    response[:, :-1] -= mean
    return response
