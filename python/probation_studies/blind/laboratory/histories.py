"""The strain that a machine is asked for: ramps, necks under grips, jumps, dwells, unloading, repeats."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray

NECKS = (
    (-0.03236, 0.37551, 0.7035, 153.25, 201.3),
    (-0.03445, 0.36637, 0.7055, 221.19, 224.7),
    (-0.04781, 0.158, 0.5632, 65.37, 262.3),
)
"""Coefficients a, b, c, d of (A-1), e = b t / (t^c + d e^(a t)), and duration [s]: peak rates of 0.017 1/s."""

_FINE = 4001


@dataclass(frozen=True)
class Schedule:
    """A strain history that is asked for.

    Attributes
    ----------
    kind : str
    control : str
        As campaign.toml calls it.
    time, strain : ndarray, shape (k,) [s], [-]
        Straight in between.
    events : tuple of float [s]
        Where the rate changes suddenly; the start is one.
    """

    kind: str
    control: str
    time: FloatArray
    strain: FloatArray
    events: tuple[float, ...]

    @property
    def duration(self) -> float:
        """[s]."""
        return float(self.time[-1])

    @property
    def unloads(self) -> bool:
        """Whether the strain is ever taken back."""
        return bool(np.any(np.diff(self.strain) < 0.0))


def _pieces(kind: str, control: str, strains: list[float], rates: list[float]) -> Schedule:
    """Straight pieces between strains at given rates."""
    moved = np.abs(np.diff(np.array([0.0, *strains])))
    time = np.concatenate([[0.0], np.cumsum(moved / np.array(rates))])
    return Schedule(kind, control, time, np.array([0.0, *strains]), tuple(time[:-1].tolist()))


def ramp(rate: float, end: float) -> Schedule:
    """One rate."""
    return _pieces("ramp", "strain-rate", [end], [rate])


def rate_jumps(random: Generator, rate: float, end: float, decades: float) -> Schedule:
    """Three to five segments, alternately faster and slower."""
    count = int(random.integers(3, 6))
    cuts = np.sort(random.uniform(0.15, 0.85, count - 1))
    cuts = np.concatenate([np.linspace(0.0, 1.0, count + 1)[1:-1] * 0.6 + 0.4 * cuts, [1.0]])
    turns = np.where(np.arange(count) % 2 == 0, 0.5, -0.5) * random.choice([-1.0, 1.0])
    rates = rate * 10.0 ** (turns * decades * random.uniform(0.6, 1.0, count))
    return _pieces("rate-jumps", "strain-rate", (cuts * end).tolist(), rates.tolist())


def dwell(random: Generator, rate: float, end: float) -> Schedule:
    """One or two pauses on the way."""
    strains = np.sort(random.uniform(0.2, 0.8, int(random.integers(1, 3)))) * end
    time, strain, events = [0.0], [0.0], [0.0]
    for stop in strains:
        time.append(time[-1] + (stop - strain[-1]) / rate)
        strain.append(float(stop))
        events.append(time[-1])
        time.append(time[-1] + end / rate * random.uniform(0.3, 1.0))
        strain.append(float(stop))
        events.append(time[-1])
    time.append(time[-1] + (end - strain[-1]) / rate)
    strain.append(end)
    return Schedule("dwell", "hold", np.array(time), np.array(strain), tuple(events))


def unloading(random: Generator, rate: float, end: float, back: float) -> Schedule:
    """One or two returns by some strain, and on."""
    stops = np.sort(random.uniform(0.3, 1.0, int(random.integers(1, 3)))) * end
    strains: list[float] = []
    for stop in stops:
        strains += [float(stop), float(stop - min(back, 0.6 * stop))]
    strains.append(end if end > strains[-1] else strains[-1] + back)
    return _pieces("unloading", "cyclic", strains, [rate] * len(strains))


def neck(random: Generator, peak_rate: float, end: float) -> Schedule:
    """Formula (A-1), on another scale of time and strain."""
    a, b, c, d, duration = NECKS[int(random.integers(len(NECKS)))]
    d *= float(np.exp(random.uniform(-0.2, 0.2)))
    time = np.linspace(0.0, duration, _FINE)
    strain = b * time / (time**c + d * np.exp(a * time))
    return _scaled("neck", time, strain, peak_rate, end)


def surge(random: Generator, peak_rate: float, end: float) -> Schedule:
    """A neck otherwise: a basic rate, and a surge of it as the neck passes."""
    time = np.linspace(0.0, 1.0, _FINE)
    middle, width = random.uniform(0.25, 0.55), random.uniform(0.08, 0.16)
    ratio = random.uniform(3.0, 9.0)
    rate = 1.0 + ratio / np.cosh((time - middle) / width) ** 2 + 0.5 / (1.0 + np.exp(-(time - middle) / width))
    strain = np.concatenate([[0.0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
    return _scaled("surge", time, strain, peak_rate, end)


def _scaled(kind: str, time: FloatArray, strain: FloatArray, peak_rate: float, end: float) -> Schedule:
    strain = strain * (end / strain[-1])
    time = time * (float(np.max(np.diff(strain) / np.diff(time))) / peak_rate)
    return Schedule(kind, "displacement-rate", time, strain, (0.0,))


def draw_schedules(
    random: Generator,
    count: int,
    slowest: float,
    fastest: float,
    end: float,
    elastic_strain: Callable[[float], float],
    needs_unloading: bool,
    gentle: bool,
) -> list[Schedule]:
    """A campaign's histories: ramps over the whole range of rates, and others between.

    Parameters
    ----------
    random : Generator
    count : int
    slowest, fastest : float [1/s]
    end : float [-]
        Largest strain.
    elastic_strain : callable
        By which an unloading from a steady flow at some rate is measured [-].
    needs_unloading : bool
    gentle : bool
        Without dwells: where the base law's times follow the rate they say more of the rate's noise than of the law.
    """
    decades = float(np.log10(fastest / slowest))
    ramps = max(2, round(0.45 * count))
    rates = slowest * 10.0 ** (decades * np.linspace(0.0, 1.0, ramps))
    found = [ramp(float(rate), end * random.uniform(0.8, 1.0)) for rate in rates]
    kinds = ["neck", "surge", "rate-jumps", "unloading", "repeat"] + ([] if gentle else ["dwell"])
    chosen = list(random.permutation(kinds))
    if needs_unloading:
        chosen = ["unloading", *(kind for kind in chosen if kind != "unloading")]
    for kind in [*chosen, *chosen][: count - ramps]:
        middle = slowest * 10.0 ** (decades * random.uniform(0.3, 0.8))
        top = end * random.uniform(0.7, 1.0)
        if kind == "neck":
            found.append(neck(random, fastest * 10.0 ** (-0.3 * decades * random.uniform()), top))
        elif kind == "surge":
            found.append(surge(random, fastest * 10.0 ** (-0.3 * decades * random.uniform()), top))
        elif kind == "rate-jumps":
            centre = slowest * 10.0 ** (0.5 * decades)
            found.append(rate_jumps(random, centre, top, min(decades, 1.3)))
        elif kind == "unloading":
            found.append(unloading(random, middle, top, float(np.clip(1.5 * elastic_strain(middle), 0.01, 0.12))))
        elif kind == "dwell":
            found.append(dwell(random, middle, top))
        else:
            found.append(found[int(random.integers(len(found)))])
    order = random.permutation(len(found))
    return [found[k] for k in order]
