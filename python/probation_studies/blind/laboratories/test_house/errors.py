"""Errors of the records: of the force, of the strain, and of specimens that differ."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.modal import FloatArray


@dataclass(frozen=True)
class Scatter:
    """Relative standard deviations of specimens that differ."""

    modulus: float = 0.025
    alpha: float = 0.025
    hardening: float = 0.025
    section: float = 0.01


@dataclass(frozen=True)
class Errors:
    """Standard deviations of the channels.

    Attributes
    ----------
    stress : float [MPa]
        Of the stress, or of the force over the stated section.
    correlation : float
        Of its neighbouring samples: autoregressive noise of the first order.
    strain : float
        White; of the true strain, or of the extension over the gauge length.
    force_channel : bool
        Whether force and extension are recorded.
    """

    stress: float
    correlation: float
    strain: float
    force_channel: bool

    def draw_stress(self, random: Generator, count: int) -> FloatArray:
        """Stationary from the first sample on [MPa]."""
        white = random.normal(0, self.stress * np.sqrt(1 - self.correlation**2), count)
        noise = np.empty(count)
        noise[0] = random.normal(0, self.stress)
        for n in range(1, count):
            noise[n] = self.correlation * noise[n - 1] + white[n]
        return noise

    def draw_strain(self, random: Generator, count: int) -> FloatArray:
        """Of every sample."""
        return random.normal(0, self.strain, count)
