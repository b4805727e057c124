"""Strain histories whose rate is known in closed form: what methods of excitation are compared on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.histories.necking import NECKING_SETS

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.random import Generator

    from probation._arrays import FloatArray

SAMPLES = 1501
_NECKING = NECKING_SETS["P2"]
_SLOW, _FAST = 1.7e-3, 1.7e-2  # 1/s
_DURATION, _JUMP = 80.0, 40.0  # s


@dataclass(frozen=True, eq=False)
class KnownHistory:
    """Samples of one history.

    Attributes
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
        Without noise.
    strain_rate : ndarray, shape (n_times,) [1/s]
        Their true rate; at a jump, the one before it.
    """

    time: FloatArray
    true_strain: FloatArray
    strain_rate: FloatArray


def _necking(random: Generator) -> KnownHistory:
    time = np.linspace(0.0, _NECKING.duration, SAMPLES)
    return KnownHistory(time, _NECKING.true_strain(time), _NECKING.strain_rate(time))


def _other_necking(random: Generator) -> KnownHistory:
    """A ramp, a logistic step and a fading start: peak over smallest rate 10, end strain 1.8, no (A-1)."""
    time = np.linspace(0.0, _NECKING.duration, SAMPLES)
    s = time / _NECKING.duration
    width, fading = 0.07, 0.5
    step = 1.0 / (1.0 + np.exp(-(s - 0.42) / width))
    start = 1.0 / (1.0 + np.exp(0.42 / width))
    faded = 1.0 - np.exp(-1.0 / fading)
    strain = 0.35 * s + 1.1 * (step - start) + 0.35 * (1.0 - np.exp(-s / fading)) / faded
    slope = 0.35 + 1.1 * step * (1.0 - step) / width + 0.35 * np.exp(-s / fading) / fading / faded
    return KnownHistory(time, strain, slope / _NECKING.duration)


def _uneven(random: Generator) -> KnownHistory:
    steps = np.exp(0.8 * random.normal(size=SAMPLES - 1))
    time = np.concatenate([[0.0], np.cumsum(steps) / steps.sum() * _NECKING.duration])
    return KnownHistory(time, _NECKING.true_strain(time), _NECKING.strain_rate(time))


def _gaps(random: Generator) -> KnownHistory:
    whole = _necking(random)
    keep = np.ones(SAMPLES, dtype=bool)
    keep[420:495] = keep[1000:1075] = False
    return KnownHistory(whole.time[keep], whole.true_strain[keep], whole.strain_rate[keep])


def _jump(random: Generator) -> KnownHistory:
    time = np.linspace(0.0, _DURATION, SAMPLES)
    at = _JUMP + time[1] * random.uniform(-0.5, 0.5)
    fast = time > at
    strain = np.where(fast, _SLOW * at + _FAST * (time - at), _SLOW * time)
    return KnownHistory(time, strain, np.where(fast, _FAST, _SLOW))


def _grip_jump(random: Generator) -> KnownHistory:
    """The stretch rises in straight lines, so that the rate falls on both sides of its jump."""
    time = np.linspace(0.0, _DURATION, SAMPLES)
    at = _JUMP + time[1] * random.uniform(-0.5, 0.5)
    fast = time > at
    stretch = np.where(fast, 1.0 + _SLOW * at + _FAST * (time - at), 1.0 + _SLOW * time)
    return KnownHistory(time, np.log(stretch), np.where(fast, _FAST, _SLOW) / stretch)


KNOWN_HISTORIES: dict[str, tuple[str, Callable[[Generator], KnownHistory]]] = {
    "necking": ("necking by (A-1), set P2, 1501 samples", _necking),
    "other-necking": ("necking by another formula", _other_necking),
    "uneven": ("necking, steps log-normal with sigma 0.8", _uneven),
    "gaps": ("necking, two gaps of 5 % each", _gaps),
    "jump": ("rate 1.7e-3, from 40 s on 1.7e-2 1/s", _jump),
    "grip-jump": ("grips ten times faster from 40 s on", _grip_jump),
}
"""By name: what it is, and a function that samples it; jumps fall between samples, anew with each draw."""
