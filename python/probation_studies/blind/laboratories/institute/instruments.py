"""What the force cell and the extensometer add.

Force: white noise, flicker noise below a corner frequency, S(f) = S_w (1 + f_c/f), as bridge amplifiers have it
(Horowitz and Hill, The Art of Electronics, 3rd ed., section 8.1), steps of the resolution, and a gain within class 0.5
of ISO 7500-1, the same in all records: the base law takes it up in its moduli. Strain: white noise, a part that haze in
the chamber correlates (Jones and Reu, Experimental Mechanics 58, 2018), steps of a clip-on extensometer; the first
sample has it, too.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.modal import FloatArray

_TONES = 60


@dataclass(frozen=True)
class Instruments:
    """How a campaign is measured.

    Attributes
    ----------
    stress : float [MPa]
        White noise of the force over the first section, without rounding.
    corner : float
        Corner frequency, in turns per duration of a record.
    stress_step : float [MPa]
    gain : float
        Shown force over the true one.
    strain : float
        Standard deviation of a strain sample, without rounding.
    correlated : float
        Part of its variance that is correlated.
    correlation : float
        Correlation time, in parts of the mean sampling interval.
    strain_step : float
        0 for image correlation.
    """

    stress: float
    corner: float
    stress_step: float
    gain: float
    strain: float
    correlated: float
    correlation: float
    strain_step: float

    def flicker(self, time: FloatArray) -> FloatArray:
        """Tones of independent amplitudes of variance 1 that make up the flicker noise [MPa], (n, 2 _TONES).

        A tone of every logarithmic part of the band has the variance of that part: S_w f_c ln(width).
        """
        length, n = time[-1] - time[0], len(time)
        edges = np.logspace(np.log10(0.2), np.log10(0.5 * n), _TONES + 1)  # turns per duration
        turns = np.sqrt(edges[1:] * edges[:-1])
        power = self.stress**2 * self.corner / (0.5 * n) * np.log(edges[1:] / edges[:-1])
        phase = 2.0 * np.pi * np.outer((time - time[0]) / length, turns)
        return np.asarray(np.hstack([np.cos(phase), np.sin(phase)]) * np.sqrt(np.tile(power, 2)))

    def stress_covariance(self, time: FloatArray, strain: FloatArray) -> FloatArray:
        """Of the recorded true stress [MPa^2]: the force's, over the section that is left."""
        slow = self.flicker(time)
        force = slow @ slow.T + (self.stress**2 + self.stress_step**2 / 12.0) * np.eye(len(time))
        return np.asarray(np.exp(strain)[:, None] * force * np.exp(strain))

    def strain_covariance(self, time: FloatArray) -> FloatArray:
        """Of the recorded strain."""
        apart = np.abs(time[:, None] - time) / (self.correlation * np.mean(np.diff(time)))
        slow = self.correlated * self.strain**2 * np.exp(-apart)
        return np.asarray(slow + (self._white**2 + self.strain_step**2 / 12.0) * np.eye(len(time)))

    @property
    def _white(self) -> float:
        return float(self.strain * np.sqrt(1.0 - self.correlated))

    def read_force(self, random: Generator, time: FloatArray, force: FloatArray) -> FloatArray:
        """What is shown for a force over the first section [MPa]; without the gain."""
        slow = self.flicker(time)
        shown = force + slow @ random.standard_normal(slow.shape[1]) + self.stress * random.standard_normal(len(time))
        return np.asarray(np.round(shown / self.stress_step) * self.stress_step)

    def read_strain(self, random: Generator, time: FloatArray, strain: FloatArray) -> FloatArray:
        """What is shown for a strain."""
        slow = np.empty(len(time))
        slow[0] = random.standard_normal()
        kept = np.exp(-np.diff(time) / (self.correlation * np.mean(np.diff(time))))
        for n, part in enumerate(kept):
            slow[n + 1] = part * slow[n] + np.sqrt(1.0 - part**2) * random.standard_normal()
        shown = strain + self._white * random.standard_normal(len(time))
        shown = shown + self.strain * np.sqrt(self.correlated) * slow
        return np.asarray(np.round(shown / self.strain_step) * self.strain_step) if self.strain_step else shown


def draw_instruments(random: Generator, flow_stress: float, most: float) -> Instruments:
    """A clip-on extensometer (5e-6 to 1e-4, in steps) or image correlation (3e-5 to 1e-3); `most` at most."""
    clip_on = random.uniform() < 0.5
    low, high = (5e-6, 1e-4) if clip_on else (3e-5, 1e-3)
    strain = min(float(np.exp(random.uniform(np.log(low), np.log(high)))), most)
    stress = flow_stress * float(10.0 ** random.uniform(-3.2, -2.4))
    return Instruments(
        stress=stress,
        corner=float(10.0 ** random.uniform(-0.5, 1.2)),
        stress_step=stress * random.uniform(0.1, 1.0),
        gain=1.0 + random.uniform(-0.005, 0.005),
        strain=strain,
        correlated=0.0 if clip_on else random.uniform(0.0, 0.5),
        correlation=random.uniform(0.7, 2.5),
        strain_step=strain * random.uniform(0.3, 1.5) if clip_on else 0.0,
    )
