"""Test programmes, and the two frames that carry them out.

Electromechanical frames follow a change of speed with the lag of a drive (first order); the small servo-electric one
has an integrating loop that overshoots (second order, underdamped). Both wander: the screw by the turn, the loop in
time.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute.modal import on_grid

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.modal import FloatArray

FINER = 3
"""Steps of the integration per sample."""
_CURVE = 50  # straight parts of a command that is curved
_QUICK = 12.0  # sampling intervals that a logger stays fast after a change of command
_RESTED = 8.0  # longest relaxation times that a preload is held


@dataclass(frozen=True, eq=False)
class Programme:
    """A commanded strain history, straight between knots.

    Attributes
    ----------
    kind : {"constant", "crosshead", "multirate", "hold", "cycles", "creeping"}
    time : ndarray [s]
    strain : ndarray
    """

    kind: str
    time: FloatArray
    strain: FloatArray

    @property
    def sharp(self) -> bool:
        """Whether it turns or stops, which takes more samples."""
        return self.kind in ("cycles", "hold")

    @property
    def control(self) -> str:
        """As campaign.toml calls it."""
        named = {"crosshead": "displacement-rate", "hold": "hold", "cycles": "cyclic", "creeping": "other"}
        return named.get(self.kind, "strain-rate")


def constant(rate: float, reach: float) -> Programme:
    """One strain rate, kept by the extensometer."""
    return Programme("constant", np.array([0.0, reach / rate]), np.array([0.0, reach]))


def crosshead(rate: float, reach: float) -> Programme:
    """One speed of the crosshead: the true strain rate falls as the specimen grows."""
    travel = np.linspace(0.0, np.expm1(reach), _CURVE)
    return Programme("crosshead", travel / rate, np.log1p(travel))


def multirate(rates: tuple[float, ...], reach: float) -> Programme:
    """Equal parts of strain at several rates."""
    part = reach / len(rates)
    durations = [part / rate for rate in rates]
    return Programme("multirate", np.cumsum([0.0, *durations]), np.linspace(0.0, reach, len(rates) + 1))


def hold(rate: float, reach: float, wait: float) -> Programme:
    """A ramp, a hold at six tenths of the reach, a second ramp."""
    part = 0.6 * reach
    time = np.cumsum([0.0, part / rate, wait, (reach - part) / rate])
    return Programme("hold", time, np.array([0.0, part, part, reach]))


def cycles(rate: float, reach: float, drop: float, number: int) -> Programme:
    """Loading with unloadings by a strain of `drop`, and reloadings."""
    corners = [0.0]
    for k in range(1, number + 1):
        corners += [reach * k / (number + 1), reach * k / (number + 1) - drop]
    corners.append(reach)
    strain = np.array(corners)
    return Programme("cycles", np.concatenate([[0.0], np.cumsum(np.abs(np.diff(strain)) / rate)]), strain)


def creeping(rate: float, reach: float, duration: float, power: float) -> Programme:
    """A ramp to a third of the reach, then slower and slower as in creep: a power of time (Findley)."""
    first = reach / 3.0
    begin = first / rate
    scale = duration * (power * (reach - first) / (duration * rate)) ** (1.0 / (1.0 - power))
    later = duration * np.linspace(0.0, 1.0, _CURVE) ** 3  # dense where the curve is steep
    grown = (later + scale) ** power - scale**power
    return Programme(
        "creeping",
        np.concatenate([[0.0], begin + later]),
        np.concatenate([[0.0], first + (reach - first) * grown / grown[-1]]),
    )


@dataclass(frozen=True, eq=False)
class Path:
    """What the specimen did, on the grid; the record begins at node `first` and has every FINER-th one.

    Attributes
    ----------
    time : ndarray [s]
        Negative while the preload is applied.
    strain : ndarray
    first : int
    """

    time: FloatArray
    strain: FloatArray
    first: int

    @property
    def samples(self) -> slice:
        """Of arrays at the nodes."""
        return slice(self.first, None, FINER)


def carry_out(
    random: Generator, programme: Programme, samples: int, *, servo: bool, logged: bool, preload: float, longest: float
) -> Path:
    """Run a programme.

    Parameters
    ----------
    samples : int
    servo : bool
        The servo-electric frame; an electromechanical one if not.
    logged : bool
        The logger is fast after changes of command and with the strain; even in time if not.
    preload : float
        Strain that is held before the record begins; 0 for none.
    longest : float [s]
        Relaxation time that a preload is held for several times.
    """
    time = _instants(programme, samples, logged=logged)
    interval = float(np.min(np.diff(time)))
    nodes = np.interp(np.arange((samples - 1) * FINER + 1) / FINER, np.arange(samples), time)
    slopes = np.diff(programme.strain) / np.diff(programme.time)
    decay = 1.0 / (interval * random.uniform(3.0, 8.0))
    turn = decay * random.uniform(0.5, 1.5) if servo else 0.0
    lead = -random.uniform(0.1, 0.5) * decay / turn if servo else 0.0
    strain = np.zeros_like(nodes)
    for at, jump in zip(programme.time, np.diff(slopes, prepend=0.0), strict=False):
        strain += jump * _followed(np.maximum(nodes - at, 0.0), decay, turn, lead)
    strain = _wandering(random, nodes, strain, servo=servo)
    first = 0
    if preload > 0.0:
        slow = preload / slopes[0] * 10.0
        parts = 60
        before = -_RESTED * longest - slow + np.linspace(0.0, slow, parts)
        rest = -_RESTED * longest * np.linspace(1.0, 0.0, parts + 1)[1:-1]
        nodes = np.concatenate([before, rest, nodes])
        strain = np.concatenate([np.linspace(0.0, preload, parts), np.full(parts - 1, preload), preload + strain])
        first = 2 * parts - 1
    return Path(on_grid(nodes), on_grid(strain), first)


def _instants(programme: Programme, samples: int, *, logged: bool) -> FloatArray:
    """When samples are taken [s]."""
    length = programme.time[-1]
    fine = np.linspace(0.0, length, 20 * samples)
    if not logged:
        return np.linspace(0.0, length, samples)
    path = np.interp(fine, programme.time, np.concatenate([[0.0], np.cumsum(np.abs(np.diff(programme.strain)))]))
    slopes = np.diff(programme.strain) / np.diff(programme.time)
    changes = np.abs(np.diff(slopes, prepend=0.0)) > 0.1 * np.abs(slopes).max()
    density = 0.4 / length + 0.6 * np.gradient(path, fine) / path[-1]
    quick = _QUICK * length / samples
    for at in programme.time[:-1][changes]:
        since = fine - at
        density += np.where(since >= 0.0, 2.0 * np.exp(-since / quick), 0.0) / length
    spent = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * np.diff(fine))])
    return np.asarray(np.interp(np.linspace(0.0, spent[-1], samples), spent, fine))


def _followed(since: FloatArray, decay: float, turn: float, lead: float) -> FloatArray:
    """Integral of the answer 1 - exp(-a s)(cos b s + k sin b s) of the speed to a jump of its command."""
    fading, square = np.exp(-decay * since), decay**2 + turn**2
    cosine, sine = np.cos(turn * since), np.sin(turn * since)
    of_cosine = (fading * (turn * sine - decay * cosine) + decay) / square
    of_sine = (turn - fading * (decay * sine + turn * cosine)) / square
    return np.asarray(since - of_cosine - lead * of_sine)


def _wandering(random: Generator, time: FloatArray, strain: FloatArray, *, servo: bool) -> FloatArray:
    """Some tenths of a per cent of the speed, in two waves: along time, or along the travel of the screw."""
    along = time / time[-1] if servo else strain / np.abs(strain).max()
    middle = 0.5 * (along[1:] + along[:-1])
    wander = np.zeros_like(middle)
    for _ in range(2):
        waves, phase = random.uniform(0.5, 8.0), random.uniform(0.0, 2.0 * np.pi)
        wander += random.normal(0.0, 0.002) * np.sin(2.0 * np.pi * waves * middle + phase)
    return np.concatenate([[0.0], np.cumsum(np.diff(strain) * (1.0 + wander))])
