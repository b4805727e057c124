"""A series of tests before anything is wrong: polymer, programmes, specimens, chamber, instruments."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.institute import programmes
from probation_studies.blind.laboratories.institute.instruments import Instruments, draw_instruments
from probation_studies.blind.laboratories.institute.modal import (
    STEADY,
    Course,
    FloatArray,
    Polymer,
    plain,
    rate_on_grid,
    solve,
)

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.programmes import Path, Programme

CHAMBER = 10.0, 23.0, 35.0
"""Temperatures of the climate chamber [°C]."""
_NOISE_IN_STEPS = 0.15
"""Strain noise over a sample's step, at most, where relaxation times go with the rate: rates are read off steps."""
_MORE = 1.6
"""Samples of programmes with corners, over those of others."""
USUAL_TEMPERATURE = 23.0


@dataclass(frozen=True)
class Specimen:
    """Relative deviations: modulus, relaxation time, hardening modulus, section."""

    modulus: float = 0.0
    time: float = 0.0
    hardening: float = 0.0
    area: float = 0.0

    def of(self, polymer: Polymer) -> Polymer:
        """What it is made of."""
        return replace(
            polymer,
            modulus=polymer.modulus * (1.0 + self.modulus),
            time=polymer.time * (1.0 + self.time),
            hardening=polymer.hardening * (1.0 + self.hardening),
        )

    @property
    def values(self) -> FloatArray:
        """In this order."""
        return np.array([self.modulus, self.time, self.hardening, self.area])


@dataclass(frozen=True)
class Setting:
    """Sizes of a series that forms of causes are measured by.

    Attributes
    ----------
    rate : float [1/s]
        The usual one.
    reach : float
        Largest strain.
    modulus, flow_stress : float [MPa]
    time : float [s]
        Longest relaxation time at the usual rate.
    """

    rate: float
    reach: float
    modulus: float
    flow_stress: float
    time: float


@dataclass(frozen=True, eq=False)
class Test:
    """One specimen's test.

    Attributes
    ----------
    id : str
    programme : Programme
    path : Path
    polymer : Polymer
        Of the mean specimen.
    specimen : Specimen
    temperature : float [°C]
    place : float
        In the series: 0 for the first test, 1 for the last.
    held_out : bool
    setting : Setting
    """

    id: str
    programme: Programme
    path: Path
    polymer: Polymer
    specimen: Specimen
    temperature: float
    place: float
    held_out: bool
    setting: Setting

    @property
    def time(self) -> FloatArray:
        """On the grid [s]."""
        return self.path.time

    @property
    def strain(self) -> FloatArray:
        """On the grid."""
        return self.path.strain

    @cached_property
    def rate(self) -> FloatArray:
        """On the grid [1/s]."""
        return rate_on_grid(self.time, self.strain)

    @cached_property
    def largest(self) -> FloatArray:
        """Largest strain so far, on the grid."""
        return np.asarray(np.maximum.accumulate(self.strain))

    @cached_property
    def travelled(self) -> FloatArray:
        """Strain there and back so far, on the grid."""
        return np.concatenate([[0.0], np.cumsum(np.abs(np.diff(self.strain)))])

    @cached_property
    def course(self) -> Course:
        """What the mean specimen goes through."""
        return plain(self.polymer, self.time, self.strain)

    @cached_property
    def stress(self) -> FloatArray:
        """Of the mean specimen, at the nodes [MPa]."""
        return np.asarray(solve(self.time, [self.course])[0])


@dataclass(frozen=True, eq=False)
class Series:
    """A series of tests.

    Attributes
    ----------
    polymer : Polymer
    tests : tuple of Test
        In the order in which they are made.
    instruments : Instruments
    scatter : Specimen, optional
        Standard deviations of specimens; None where they are alike.
    stated : bool
        Whether the institute knows the scatter from earlier series, and says so.
    replicates : int
        Specimens per programme.
    surface_seen : bool
        Whether the specimens' temperature is recorded.
    setting : Setting
    """

    polymer: Polymer
    tests: tuple[Test, ...]
    instruments: Instruments
    scatter: Specimen | None
    stated: bool
    replicates: int
    surface_seen: bool
    setting: Setting


def draw_series(random: Generator, needs: frozenset[str], *, replicated: bool | None) -> Series:
    """Draw one in which what `needs` says can show; replicates that differ if asked for, none that do if False."""
    turning = bool(needs & {"cycles", "deep"})
    companion = not turning and random.uniform() < 0.35
    rate = float(10.0 ** random.uniform(-3.6, -2.2))
    modulus = float(np.exp(random.uniform(np.log(500.0), np.log(3500.0))))
    hardening = modulus * float(10.0 ** random.uniform(-3.1, -2.6))
    if companion:
        polymer = Polymer(modulus, random.uniform(0.85, 1.2), hardening, (0.00464, 0.0367))
    else:
        polymer = Polymer(modulus, random.uniform(0.012, 0.035) / rate, hardening)
    longest = float(np.exp(polymer.log_time(np.array(rate))))
    flow = STEADY * modulus * longest * rate
    setting = Setting(rate, random.uniform(0.25, 1.0), modulus, flow, longest)
    differ = (random.uniform() < 0.5) if replicated is None else replicated
    alike_copies = random.uniform() < 0.5
    copies = int(random.integers(2, 4)) if differ or alike_copies else 1
    planned = _draw_programmes(random, setting, needs, companion=companion, most=3 if copies > 1 else 5)
    cold = len(planned) > 1 and ("temperatures" in needs or random.uniform() < 0.08)
    usual = USUAL_TEMPERATURE if cold else float(random.choice(CHAMBER, p=[0.2, 0.6, 0.2]))
    degrees = [float(each) for each in random.choice(CHAMBER, len(planned))] if cold else [usual] * len(planned)
    if cold and len(set(degrees)) == 1:
        degrees[0] = float(random.choice([each for each in CHAMBER if each != degrees[0]]))
    held = int(random.integers(len(planned))) if len(planned) >= 3 and random.uniform() < 0.4 else -1
    scatter = Specimen(*(float(each) for each in random.uniform(0.01, 0.04, 4))) if differ else None
    samples = int(np.exp(random.uniform(np.log(220.0), np.log(380.0 if copies > 1 else 650.0))))
    servo, logged = random.uniform() < 0.35, random.uniform() < 0.4
    preload = float(random.uniform(2e-4, 1e-3)) if not companion and random.uniform() < 0.25 else 0.0
    order = random.permutation(np.repeat(np.arange(len(planned)), copies))
    tests = []
    for n, k in enumerate(order):
        count = int(samples * _MORE) if planned[k].sharp else samples
        path = programmes.carry_out(
            random, planned[k], count, servo=servo, logged=logged, preload=preload, longest=longest
        )
        drawn = Specimen() if scatter is None else Specimen(*(random.standard_normal(4) * scatter.values).tolist())
        place = n / max(len(order) - 1, 1)
        name = f"{n + 1:02d}-{planned[k].kind}"
        test = Test(name, planned[k], path, polymer, drawn, degrees[k], place, bool(k == held), setting)
        tests.append(test)
    usual_step = min(float(np.quantile(np.diff(test.strain[::2][test.path.samples]), 0.1)) for test in tests)
    instruments = draw_instruments(random, flow, _NOISE_IN_STEPS * usual_step if companion else np.inf)
    stated, seen = scatter is not None and random.uniform() < 0.3, cold or random.uniform() < 0.3
    return Series(polymer, tuple(tests), instruments, scatter, stated, copies, seen, setting)


def _draw_programmes(
    random: Generator, setting: Setting, needs: frozenset[str], *, companion: bool, most: int
) -> list[Programme]:
    """Two constant rates at least where rates or temperatures are wanted, and what the causes need."""
    spread = 10.0 if companion else 3.0
    drop = setting.flow_stress / setting.modulus * (random.uniform(1.6, 2.2) if "deep" in needs else 0.8)
    kinds = ["cycles"] if needs & {"cycles", "deep"} else []
    others = ["constant", "crosshead", "multirate", "hold", "cycles", "creeping"]
    weights = np.array([3.0, 2.0, 2.0, 2.0, 2.0, 1.5])
    if companion:
        weights[3:] = 0.0
    count = max(int(random.integers(2, most + 1)), 2)
    kinds += ["constant"] * (1 if len(kinds) == 0 else 0)
    while len(kinds) < count:
        kinds.append(str(random.choice(others, p=weights / weights.sum())))
    found = []
    for n, kind in enumerate(kinds):
        rate = setting.rate * (1.0 if n == 0 else spread ** random.uniform(-1.0, 1.0))
        reach = setting.reach * random.uniform(0.6, 1.0)
        if kind == "constant":
            found.append(programmes.constant(rate, reach))
        elif kind == "crosshead":
            found.append(programmes.crosshead(rate, reach))
        elif kind == "multirate":
            rates = rate * spread ** random.uniform(-0.6, 0.6, int(random.integers(2, 5)))
            found.append(programmes.multirate(tuple(float(each) for each in rates), reach))
        elif kind == "hold":
            found.append(programmes.hold(setting.rate, reach, setting.time * random.uniform(1.0, 8.0)))
        elif kind == "cycles":
            found.append(programmes.cycles(setting.rate, reach, min(drop, 0.25 * reach), int(random.integers(2, 5))))
        else:
            duration = reach / setting.rate * random.uniform(4.0, 12.0)
            found.append(programmes.creeping(setting.rate, reach, duration, random.uniform(0.25, 0.5)))
    return found
