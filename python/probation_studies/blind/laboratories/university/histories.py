"""Test programmes and the servo-hydraulic machine that carries them out."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.signal import bilinear, lfilter

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray

FINER = 4
"""Steps of the integration per sample."""


@dataclass(frozen=True)
class Programme:
    """A commanded test.

    Attributes
    ----------
    kind : {"ramp", "loops", "relaxation", "jumps", "grip"}
    segments : tuple of (float, float)
        Commanded true strain rate [1/s] and duration [s], one after the other; of "grip" the mean rate.
    localisation : float
        Of "grip": largest rate over the first.
    """

    kind: str
    segments: tuple[tuple[float, float], ...]
    localisation: float = 1.0

    @property
    def duration(self) -> float:
        """[s]."""
        return sum(length for _, length in self.segments)

    @property
    def control(self) -> str:
        """As campaign.toml calls it."""
        return {"relaxation": "hold", "loops": "cyclic", "grip": "displacement-rate"}.get(self.kind, "strain-rate")


def ramp(rate: float, strain: float) -> Programme:
    """At one rate."""
    return Programme("ramp", ((rate, strain / rate),))


def loops(rate: float, strain: float, drop: float, count: int) -> Programme:
    """Loading with `count` partial unloadings by a strain of `drop`."""
    part = strain / (count + 1)
    segments: list[tuple[float, float]] = []
    for k in range(count + 1):
        segments.append((rate, (part + (drop if k else 0.0)) / rate))
        if k < count:
            segments.append((-rate, drop / rate))
    return Programme("loops", tuple(segments))


def relaxation(rate: float, strain: float, hold: float) -> Programme:
    """A ramp and a hold [s]."""
    return Programme("relaxation", ((rate, strain / rate), (0.0, hold)))


def jumps(rates: tuple[float, ...], strain: float) -> Programme:
    """Equal parts of strain at several rates."""
    part = strain / len(rates)
    return Programme("jumps", tuple((rate, part / rate) for rate in rates))


def grip(rate: float, strain: float, localisation: float) -> Programme:
    """Constant speed of the grips: the section's rate rises as the neck passes, and falls again."""
    return Programme("grip", ((rate, strain / rate),), localisation)


def carry_out(random: Generator, programme: Programme, samples: int) -> tuple[FloatArray, FloatArray]:
    """Time [s] and true strain of the specimen, on FINER times as many steps as samples.

    The loop is proportional-integral with feed-forward f around a servo-valve of time constant T:
    strain/command = (f s^2 + P s + I)/(T s^3 + s^2 + P s + I); T, 1/P are a few sampling intervals, f is 0.96 to 1.02.
    The hydraulic supply makes the speed wander by some tenths of a per cent.
    """
    time = np.linspace(0.0, programme.duration, (samples - 1) * FINER + 1)
    step = time[1]
    command = _commanded(programme, time)
    interval = step * FINER
    valve = interval * random.uniform(0.3, 0.8)
    gain = 1.0 / (interval * random.uniform(1.5, 4.0))
    integral = gain**2 * random.uniform(0.02, 0.15)
    forward = random.uniform(0.96, 1.02)
    b, a = bilinear([forward, gain, integral], [valve, 1.0, gain, integral], fs=1.0 / step)
    strain = lfilter(b, a, command)
    rate = np.gradient(strain, step)
    wander = np.zeros_like(time)
    for _ in range(3):
        cycles, phase = random.uniform(0.7, 6.0), random.uniform(0.0, 2.0 * np.pi)
        wander += random.normal(0.0, 0.002) * np.sin(2.0 * np.pi * cycles * time / time[-1] + phase)
    strain = strain + np.concatenate([[0.0], np.cumsum(0.5 * (rate * wander)[1:] + 0.5 * (rate * wander)[:-1]) * step])
    return time, strain - strain[0]


def _commanded(programme: Programme, time: FloatArray) -> FloatArray:
    if programme.kind == "grip":
        rate, length = programme.segments[0]
        x = time / length
        bump = 1.0 / np.cosh((x - 0.33) / 0.16) ** 2
        speed = 1.0 + (programme.localisation - 1.0) * bump
        path = np.concatenate([[0.0], np.cumsum(0.5 * (speed[1:] + speed[:-1]))])
        return np.asarray(rate * length * path / path[-1])
    knots = np.cumsum([0.0, *(length for _, length in programme.segments)])
    values = np.cumsum([0.0, *(rate * length for rate, length in programme.segments)])
    return np.asarray(np.interp(time, knots, values))
