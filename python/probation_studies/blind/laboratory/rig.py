"""What the machine does with what it is asked for, and when it takes samples."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.signal import lfilter

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.histories import Schedule
    from probation_studies.blind.laboratory.material import FloatArray

REFINEMENT = 4
"""Steps of the truth's integration per sample."""

_MASTER = 12


@dataclass(frozen=True)
class Driven:
    """A test as the machine ran it.

    Attributes
    ----------
    schedule : Schedule
    time : ndarray, shape (n,) [s]
        Instants of the samples.
    fine_time : ndarray, shape (4 (n - 1) + 1,) [s]
        Every fourth is a sample.
    fine_strain : ndarray [-]
    """

    schedule: Schedule
    time: FloatArray
    fine_time: FloatArray
    fine_strain: FloatArray

    @property
    def strain(self) -> FloatArray:
        """At the samples, shape (n,)."""
        return self.fine_strain[::REFINEMENT]


@dataclass(frozen=True)
class Controller:
    """The closed loop as a damped oscillator, and what shakes it.

    Attributes
    ----------
    response_samples : float
        Natural period over 2 pi, in samples.
    damping : float
    disturbance : float [-]
        Standard deviation of the strain that the loop does not hold.
    logged : float
        How many times denser samples are just after an event, where the logger follows events.
    logs_ramps : bool
        Whether it does so in histories without other events than the start, too; else these have an even clock.
    """

    response_samples: float
    damping: float
    disturbance: float
    logged: float
    logs_ramps: bool


def draw_controller(random: Generator) -> Controller:
    """A servo-hydraulic or screw-driven machine's."""
    return Controller(
        response_samples=random.uniform(4.0, 8.0),
        damping=random.uniform(0.6, 1.0),
        disturbance=10.0 ** random.uniform(-5.5, -4.3),
        logged=random.uniform(3.0, 6.0),
        logs_ramps=bool(random.uniform() < 0.3),
    )


def drive(random: Generator, schedule: Schedule, samples: int, controller: Controller) -> Driven:
    """Run a schedule on the machine."""
    logged = controller.logged if controller.logs_ramps or len(schedule.events) > 1 else 1.0
    step = schedule.duration / (_MASTER * samples)
    master = np.arange(_MASTER * samples + 1) * step
    asked = np.interp(master, schedule.time, schedule.strain)
    spacing = schedule.duration / samples / logged**0.7
    period = controller.response_samples * spacing
    followed = _closed_loop(asked, step / period, controller.damping)
    shaken = _closed_loop(random.standard_normal(len(master)), step / (1.5 * period), 0.8)
    scale = controller.disturbance / (np.std(shaken) + 1e-30)
    followed = followed + scale * (shaken - shaken[0]) * (1.0 - np.exp(-master / (3.0 * period)))
    time = _instants(schedule, samples, logged)
    fine = np.concatenate(
        [(time[:-1, None] + np.diff(time)[:, None] * np.arange(REFINEMENT) / REFINEMENT).ravel(), time[-1:]]
    )
    strain = CubicSpline(master, followed - followed[0])(fine)
    return Driven(schedule, time, fine, np.asarray(strain))


def _closed_loop(asked: FloatArray, step_over_period: float, damping: float) -> FloatArray:
    """Follow y'' + 2 d w y' + w^2 y = w^2 x by the bilinear rule, from rest."""
    c = 2.0 / step_over_period
    a0, a1, a2 = c * c + 2.0 * damping * c + 1.0, 2.0 - 2.0 * c * c, c * c - 2.0 * damping * c + 1.0
    return np.asarray(lfilter([1.0 / a0, 2.0 / a0, 1.0 / a0], [1.0, a1 / a0, a2 / a0], asked - asked[0]))


def _instants(schedule: Schedule, samples: int, logged: float) -> FloatArray:
    """An even clock, or one that runs faster just after the rate has changed."""
    even = np.linspace(0.0, schedule.duration, samples)
    if logged <= 1.0:
        return even
    window = 0.03 * schedule.duration
    grid = np.linspace(0.0, schedule.duration, 20 * samples)
    density = np.ones_like(grid)
    for event in schedule.events:
        since = (grid - event + 0.2 * window) / window
        density += (logged - 1.0) * np.exp(-np.maximum(since, 0.0)) * (1.0 + np.tanh(8.0 * since)) / 2.0
    passed = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]))])
    return np.asarray(np.interp(np.linspace(0.0, passed[-1], samples), passed, grid))
