"""Noise of the channels, which is not what a fitted model assumes: white, 1/f, in bursts, in steps of a converter."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky

from probation_studies.blind.laboratory.material import TIME_RATIO, WEIGHT

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import BaseLaw, FloatArray

_OCTAVES = np.array([0.003, 0.01, 0.03, 0.1, 0.3])
"""Correlation times over the record of the processes whose sum is near 1/f."""


@dataclass(frozen=True)
class Noise:
    """What the channels of one campaign add.

    Attributes
    ----------
    stress : float [MPa]
        White part of the stress.
    on_force : bool
        Constant in force, so that it grows with the stretch in the true stress.
    drift : float
        Of the 1/f part over the white one.
    burst : float
        Gain within a burst; 1 for none.
    burst_part : float
        Part of the record in bursts.
    memory : float
        Of a white sample in the next one.
    quantum : float [MPa]
        Step of the force converter; 0 for none.
    strain : float [-]
        White noise of the recorded strain.
    strain_quantum : float [-]
    filter_samples : float
        Time constant of the low pass that both channels go through; 0 for none.
    first_strain : bool
        Whether the first sample of the strain is as noisy as the others; else it is exact.
    """

    stress: float
    on_force: bool
    drift: float
    burst: float
    burst_part: float
    memory: float
    quantum: float
    strain: float
    strain_quantum: float
    filter_samples: float
    first_strain: bool = False


def draw_noise(random: Generator, largest_stress: float, gentle: bool) -> Noise:
    """Noise that a laboratory would have; `gentle` keeps the strain clean."""
    level = min(10.0 ** random.uniform(np.log10(0.02), np.log10(0.3)), 0.006 * largest_stress)
    quiet = gentle or random.uniform() < 0.6
    return Noise(
        stress=float(level),
        on_force=bool(random.uniform() < 0.5),
        drift=float(random.choice([0.0, random.uniform(0.1, 0.8)])),
        burst=float(random.choice([1.0, 1.0, random.uniform(2.0, 5.0)])),
        burst_part=random.uniform(0.02, 0.08),
        memory=float(random.choice([0.0, random.uniform(0.1, 0.5)])),
        quantum=float(level * random.choice([0.0, random.uniform(0.2, 1.2)])),
        strain=0.0 if quiet else float(10.0 ** random.uniform(-6.0, -4.3)),
        strain_quantum=0.0,
        filter_samples=float(random.choice([0.0, 0.0, random.uniform(0.2, 0.6)])),
    )


@dataclass(frozen=True)
class RecordNoise:
    """One record's noise: what was drawn, and the covariance that it was drawn from.

    Attributes
    ----------
    rough, drift, strain : ndarray, shape (n,) [MPa], [MPa], [-]
        White part and drift of the stress; noise of the strain.
    factor : ndarray, shape (n, n) [MPa]
        Lower Cholesky factor of the covariance of the recorded stress, given the recorded strain.
    """

    rough: FloatArray
    drift: FloatArray
    strain: FloatArray
    factor: FloatArray

    @property
    def level(self) -> float:
        """Root mean square of the standard deviations [MPa]."""
        return float(np.sqrt(np.sum(self.factor**2) / len(self.factor)))


def draw_record_noise(
    random: Generator,
    noise: Noise,
    law: BaseLaw,
    time: FloatArray,
    strain: FloatArray,
    scattered: FloatArray | None = None,
) -> RecordNoise:
    """Draw the noise of one record, sampled at `time` along `strain`.

    `scattered` is what its specimen may add, one standard deviation a column, shape (n, k) [MPa].
    """
    n = len(time)
    profile = np.exp(strain) if noise.on_force else np.ones(n)
    bursts = np.ones(n)
    if noise.burst > 1.0:
        length = max(int(0.02 * n), 3)
        for _ in range(max(1, round(noise.burst_part * n / length))):
            first = int(random.integers(0, n - length))
            bursts[first : first + length] = noise.burst
    white = noise.stress * bursts * random.standard_normal(n)
    rough = profile * _smeared(white, noise.memory)
    spread = noise.stress * bursts
    own = np.full(n, np.sqrt(1.0 - noise.memory**2))
    own[0] = 1.0
    variance = (own * spread) ** 2
    variance[1:] += (noise.memory * spread[:-1]) ** 2
    next_one = own[:-1] * noise.memory * spread[:-1] ** 2 * profile[:-1] * profile[1:]
    covariance = (
        np.diag(profile**2 * (variance + noise.quantum**2 / 12.0)) + np.diag(next_one, 1) + np.diag(next_one, -1)
    )
    drift = np.zeros(n)
    if noise.drift > 0.0:
        lag = np.abs(time[:, None] - time) / (time[-1] - time[0])
        slow = np.mean([np.exp(-lag / each) for each in _OCTAVES], axis=0)
        covariance += slow * (noise.drift * noise.stress) ** 2 * np.outer(profile, profile)
        drift = profile * noise.drift * noise.stress * _pink(random, time)
    seen = np.zeros(n)
    wrong = float(np.hypot(noise.strain, noise.strain_quantum / np.sqrt(12.0)))
    if wrong > 0.0:
        seen = noise.strain * random.standard_normal(n)
        if not noise.first_strain:
            seen[0] = 0.0
        carried = strain_response(law, time, strain) * wrong
        covariance += carried @ carried.T
    if scattered is not None:
        covariance += scattered @ scattered.T
    return RecordNoise(rough, drift, seen, cholesky(covariance, lower=True))


def _smeared(white: FloatArray, memory: float) -> FloatArray:
    answer: FloatArray = white * np.sqrt(1.0 - memory**2)
    answer[0] = white[0]
    answer[1:] += memory * white[:-1]
    return answer


def _pink(random: Generator, time: FloatArray) -> FloatArray:
    """Sum of Ornstein-Uhlenbeck processes, of unit variance."""
    fade = np.exp(-np.diff(time)[:, None] / (_OCTAVES * (time[-1] - time[0])))
    kick = np.sqrt(1.0 - fade**2) * random.standard_normal(fade.shape)
    state = random.standard_normal(len(_OCTAVES))
    answer = [state.sum()]
    for m in range(len(fade)):
        state = fade[m] * state + kick[m]
        answer.append(state.sum())
    return np.asarray(np.array(answer) / np.sqrt(len(_OCTAVES)))


def strain_response(law: BaseLaw, time: FloatArray, strain: FloatArray) -> FloatArray:
    """Change of the stress at each sample with the strain of each, the law's times held; shape (n, n) [MPa]."""
    step = np.diff(time)
    rate = np.diff(strain) / step
    reduced = np.concatenate([[0.0], np.cumsum(step * np.exp(-law.log_time(rate)))])
    table = np.concatenate([[0.0], np.geomspace(1e-9, max(reduced[-1], 1e-6), 400)])
    kernel = (-np.expm1(-table[:, None] / TIME_RATIO)) @ (WEIGHT * TIME_RATIO)
    since = reduced[:, None] - reduced
    grown = np.interp(np.maximum(since, 0.0).ravel(), table, kernel).reshape(since.shape)
    mean = law.unrelaxed_modulus * (grown[:, :-1] - grown[:, 1:]) / np.diff(reduced)
    response = np.zeros((len(time), len(time)))
    response[:, 1:] += mean
    response[:, :-1] -= mean
    return response
