"""A series of tests before anything is wrong with it: polymer, programmes, specimens, errors."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.test_house.draws import LogEven
from probation_studies.blind.laboratories.test_house.errors import Errors, Scatter
from probation_studies.blind.laboratories.test_house.histories import draw_history
from probation_studies.blind.laboratories.test_house.modal import Law
from probation_studies.blind.laboratories.test_house.trial import Test

if TYPE_CHECKING:
    from numpy.random import Generator

_COARSE, _FINE = 1, 4
"""Steps between two samples: where sizes and angles are found, and in what is recorded."""
_WITH_COMPANION = 0.7
_SLOPE = 0.00464
_DEGREES = 20.0, 23.0, 27.0, 25.0, 21.0
"""Declared temperatures: there is no air conditioning [°C]."""
_FORCE_CHANNEL = 0.5

Kind = tuple[str, float]


@dataclass(frozen=True, eq=False)
class Plan:
    """All of a campaign but its causes.

    Attributes
    ----------
    law : Law
        Of the mean specimen.
    coarse, fine : tuple of Test
        The same tests for finding sizes, and to be recorded; specimens of the first are the mean.
    errors : Errors
    scatter : Scatter, optional
        None where specimens are alike; else there are two of every condition.
    with_temperature : bool
        Whether the specimens' temperatures are recorded.
    """

    law: Law
    coarse: tuple[Test, ...]
    fine: tuple[Test, ...]
    errors: Errors
    scatter: Scatter | None
    with_temperature: bool


@dataclass(frozen=True)
class _Polymer:
    """The mean law, and the strain rates for it [1/s]; tau_max times the middle one."""

    law: Law
    low: float
    middle: float
    high: float
    typical: float


def draw_plan(random: Generator, needs: frozenset[str], *, alike: bool, strain_noise: float | None) -> Plan:
    """Draw a plan.

    Parameters
    ----------
    random : Generator
    needs : frozenset of str
        What the series must contain; see `Form.needs`.
    alike : bool
        Whether specimens are.
    strain_noise : float, optional
        Drawn if left out.
    """
    polymer = _draw_polymer(random, needs)
    kinds = _draw_kinds(random, polymer, needs, alike=alike)
    coarse, fine = _draw_tests(random, polymer, kinds, needs, alike=alike)
    stress = float(random.uniform(0.03, 0.06))
    correlation = float(random.choice([0.0, random.uniform(0.2, 0.7)]))
    strain = LogEven(1e-5, 2e-4).draw(random) if strain_noise is None else strain_noise
    errors = Errors(stress, correlation, strain, bool(random.uniform() < _FORCE_CHANNEL))
    return Plan(
        polymer.law,
        tuple(replace(test, law=polymer.law, section=1.0) for test in coarse),
        tuple(fine),
        errors,
        None if alike else Scatter(),
        with_temperature=bool({"temperatures", "order"} & needs),  # in order, to exclude a room that warms
    )


def _draw_polymer(random: Generator, needs: frozenset[str]) -> _Polymer:
    if random.uniform() < _WITH_COMPANION or "fast" in needs:
        low, high = LogEven(1e-4, 4e-4).draw(random), LogEven(3e-3, 1e-2).draw(random)
        if "fast" in needs:
            high = LogEven(7e-3, 1e-2).draw(random)
        companion = (_SLOPE, float(random.choice([0.0367, 0.0406])))
        alpha, middle = float(random.uniform(0.85, 1.25)), float(np.sqrt(low * high))
        law = Law(LogEven(800.0, 3200.0).draw(random), alpha, 0.0, companion)
        typical = float(law.scaled(alpha=1.0 / alpha).tau(np.array(middle))) * middle
    else:  # without a companion relation the rates stay within less than a decade
        middle = LogEven(5e-4, 3e-3).draw(random)
        low, high = middle / random.uniform(2, 3), middle * random.uniform(2, 3)
        typical = float(random.uniform(0.02, 0.05))
        law = Law(LogEven(800.0, 2500.0).draw(random), 1.0, 0.0, None, typical / middle)
    hardening = LogEven(0.8, 4.0).draw(random) * float(np.sqrt(law.modulus / 2000.0))
    return _Polymer(replace(law, hardening=hardening), low, middle, high, typical)


def _draw_kinds(random: Generator, polymer: _Polymer, needs: frozenset[str], *, alike: bool) -> list[Kind]:
    """Of histories, with their rates [1/s]."""
    low, middle, high = polymer.low, polymer.middle, polymer.high
    kinds: list[Kind] = [("ramp", low), ("ramp", high)]
    if {"rates", "order", "temperatures"} & needs or (alike and random.uniform() < 0.6):
        kinds.append(("ramp", middle))
    special = ["jump", "necking", "unloading"]
    random.shuffle(special)
    if "unloading" in needs:
        special = ["unloading", *(each for each in special if each != "unloading")]
    for kind in special[: int(random.integers(1, 3 if alike else 2))]:
        slow = LogEven(low, middle).draw(random) if kind == "unloading" else float(low * random.uniform(1, 2))
        kinds.append((kind, slow))
    if "temperatures" in needs:
        rates = (low, high, middle, low * 1.5, high / 1.5)
        kinds = [("ramp", rate) for rate in rates][: 5 if alike else 3]
    kinds = kinds[:5] if alike else kinds[:3] if "rates" in needs else kinds[-3:]
    if "unloading" in needs and not alike:
        kinds = kinds[-2:]
    if "order" in needs:
        random.shuffle(kinds)
    return kinds


def _draw_tests(
    random: Generator, polymer: _Polymer, kinds: list[Kind], needs: frozenset[str], *, alike: bool
) -> list[list[Test]]:
    """Every test on coarse and on fine instants."""
    drawn = []
    for place, (kind, rate) in enumerate(kinds):
        for copy in "a" if alike else "ab":
            count, seed = int(random.integers(400, 1500 if alike else 1000)), int(random.integers(2**31))
            end = float(random.uniform(0.6, 0.8) if "large" in needs else random.uniform(0.3, 0.8))
            if kind == "unloading":
                count, end = 1100 + count * 400 // 1500, 0.3 + 0.3 * (end - 0.3)
            if kind == "jump":
                count = 900 + count * 600 // 1500
            law, section = polymer.law, 1.0
            if not alike:
                by, scatter = random.normal(size=4), Scatter()
                law = law.scaled(1 + scatter.modulus * by[0], 1 + scatter.alpha * by[1], 1 + scatter.hardening * by[2])
                section = 1 + scatter.section * by[3]
            name = f"{kind}-{rate:.2g}-{place if alike else copy}"
            degrees = _DEGREES[place % 5] if "temperatures" in needs else 23.0
            drawn.append((name, (kind, rate, end), seed, count, law, section, degrees))
    found = []
    for substeps in (_COARSE, _FINE):
        histories = [
            draw_history(*wanted, np.random.default_rng(seed), count, substeps) for _, wanted, seed, count, *_ in drawn
        ]
        found.append(
            [
                Test(
                    name,
                    history,
                    law,
                    section,
                    specimen=f"S{k + 1}",
                    order=k / max(len(drawn) - 1, 1),
                    temperature=degrees,
                    reference=polymer.middle,
                    typical=polymer.typical,
                    longest=max(each.time[-1] for each in histories),
                    shortest_interval=min(each.time[1] for each in histories),
                )
                for k, ((name, _, _, _, law, section, degrees), history) in enumerate(
                    zip(drawn, histories, strict=True)
                )
            ]
        )
    return found
