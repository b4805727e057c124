"""What the cell, the amplifier and the extensometer add: noise, 1/f noise, steps of resolution."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from probation_studies.blind.laboratories.industry.memory import FloatArray

_SLOW = np.array([0.03, 0.1, 0.3, 1.0, 3.0])
"""Correlation times of the 1/f noise, in durations: a sum of such processes has a spectrum of 1/f between them."""
_BITS, _RANGE = 16, 10.0


@dataclass(frozen=True)
class Instruments:
    """Sizes of what is added.

    Attributes
    ----------
    force_noise : float [MPa]
        White, over the first section.
    slow_noise : float [MPa]
        Of each part of the 1/f noise.
    force_step : float [MPa]
        Of a converter of 16 bits whose range is ten times the largest force.
    strain_noise, strain_step : float
        Of the travel over the gauge length; the first sample has it, too.
    """

    force_noise: float
    slow_noise: float
    force_step: float
    strain_noise: float
    strain_step: float

    @property
    def force_white(self) -> float:
        """White noise with that of rounding [MPa]."""
        return float(np.hypot(self.force_noise, self.force_step / np.sqrt(12.0)))

    @property
    def strain_white(self) -> float:
        """White noise with that of rounding."""
        return float(np.hypot(self.strain_noise, self.strain_step / np.sqrt(12.0)))


def draw_instruments(random: np.random.Generator, largest_force: float, *, clip_on: bool) -> Instruments:
    """Draw the sizes for a campaign."""
    white = largest_force * 10.0 ** random.uniform(-3.6, -2.5)
    strain = 10.0 ** (random.uniform(-5.3, -3.0) if clip_on else random.uniform(-5.3, -4.0))
    return Instruments(
        force_noise=white,
        slow_noise=white * random.uniform(0.02, 0.15),
        force_step=2.0 * _RANGE * largest_force / 2**_BITS,
        strain_noise=strain,
        strain_step=strain * random.uniform(0.5, 2.0) if clip_on else 1e-6,
    )


def slow_covariance(time: FloatArray, instruments: Instruments) -> FloatArray:
    """Of the 1/f noise at these times [MPa^2]."""
    apart = np.abs(time[:, None] - time[None, :]) / max(time[-1] - time[0], 1e-12)
    return np.asarray(instruments.slow_noise**2 * sum(np.exp(-apart / each) for each in _SLOW))


def read_out(
    random: np.random.Generator, time: FloatArray, travel: FloatArray, force: FloatArray, instruments: Instruments
) -> tuple[FloatArray, FloatArray]:
    """Travel and force with everything added."""
    slow = np.zeros(len(time))
    for each in _SLOW * (time[-1] - time[0]):
        kept = np.exp(-np.diff(time) / each)
        kick = np.sqrt(1.0 - kept**2) * random.standard_normal(len(time) - 1)
        now = random.standard_normal()
        course = [now]
        for factor, push in zip(kept, kick, strict=True):
            now = factor * now + push
            course.append(now)
        slow += np.array(course)
    force = force + instruments.slow_noise * slow + instruments.force_noise * random.standard_normal(len(time))
    travel = travel + instruments.strain_noise * random.standard_normal(len(time))
    return (
        np.round(travel / instruments.strain_step) * instruments.strain_step,
        np.round(force / instruments.force_step) * instruments.force_step,
    )
