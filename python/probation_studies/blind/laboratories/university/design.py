"""A campaign's design: material, programmes, specimens, errors."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratories.university.causes import Run, Setting
from probation_studies.blind.laboratories.university.errors import Errors, draw_errors
from probation_studies.blind.laboratories.university.histories import (
    Programme,
    carry_out,
    grip,
    jumps,
    loops,
    ramp,
    relaxation,
)
from probation_studies.blind.laboratories.university.modal_law import Material, base_course, integrate

if TYPE_CHECKING:
    from numpy.random import Generator

_STEADY = 0.382
"""Sum of p_j r_j: flow stress over modulus times Weissenberg number."""


@dataclass(frozen=True)
class Specimen:
    """Relative deviations of a specimen: modulus, time, hardening modulus, area."""

    modulus: float = 0.0
    time: float = 0.0
    hardening: float = 0.0
    area: float = 0.0

    def of(self, material: Material) -> Material:
        """What it is made of."""
        return replace(
            material,
            modulus=material.modulus * (1.0 + self.modulus),
            time=material.time * (1.0 + self.time),
            hardening=material.hardening * (1.0 + self.hardening),
        )


@dataclass(frozen=True, eq=False)
class Test:
    """A specimen's test.

    Attributes
    ----------
    id : str
    programme : Programme
    run : Run
        Of the mean material.
    specimen : Specimen
    held_out : bool
    """

    id: str
    programme: Programme
    run: Run
    specimen: Specimen
    held_out: bool


@dataclass(frozen=True, eq=False)
class Design:
    """A campaign before anything is wrong with it.

    Attributes
    ----------
    material : Material
    tests : tuple of Test
    errors : Errors
    scatter : Specimen, optional
        Standard deviations of specimens; None where they are alike.
    replicates : int
        Specimens per programme.
    setting : Setting
    """

    material: Material
    tests: tuple[Test, ...]
    errors: Errors
    scatter: Specimen | None
    replicates: int
    setting: Setting


def draw_design(random: Generator, *, unloading: bool, replicated: bool) -> Design:
    """Draw one; `unloading` asks for loops, `replicated` for two or three specimens per programme that differ."""
    companion = (0.00464, 0.0367) if random.uniform() < 0.4 and not unloading else None
    rate = 10.0 ** random.uniform(-3.0, -2.0)
    modulus = random.uniform(900.0, 3400.0)
    if companion is None:
        weissenberg = random.uniform(0.012, 0.03)
        material = Material(modulus, weissenberg / rate, random.uniform(1.0, 5.0))
    else:
        material = Material(modulus, random.uniform(0.85, 1.2), random.uniform(1.0, 5.0), companion)
        weissenberg = float(np.exp(material.log_time(np.array([rate]))[0])) * rate
    flow = _STEADY * modulus * weissenberg
    strain = random.uniform(0.4, 1.4)
    drop = random.uniform(0.4, 0.7) * flow / (0.6 * modulus)
    programmes = _draw_programmes(random, material, rate, strain, drop, unloading=unloading, replicated=replicated)
    replicates = int(random.choice([2, 3] if len(programmes) < 4 else [2])) if replicated else 1
    samples = int(10.0 ** random.uniform(np.log10(300.0), np.log10(1500.0 if random.uniform() < 0.15 else 800.0)))
    scatter = Specimen(*random.uniform(0.01, 0.03, size=4)) if replicated else None
    held = {int(random.integers(len(programmes)))} if len(programmes) >= 4 and random.uniform() < 0.4 else set()
    tests = []
    for k, programme in enumerate(programmes):
        for copy in range(replicates):
            time, path = carry_out(random, programme, samples)
            if float(np.min(integrate(time, [base_course(material, time, path)]))) < -0.05 * flow:
                return draw_design(random, unloading=unloading, replicated=replicated)
            run = Run(material, time, path, programme.duration / (samples - 1))
            name = f"{programme.kind}-{k + 1}" + (chr(ord("a") + copy) if replicates > 1 else "")
            tests.append(Test(name, programme, run, _draw_specimen(random, scatter), k in held))
    setting = Setting(
        rate=rate,
        strain=strain,
        duration=max(test.programme.duration for test in tests),
        sampling=tests[0].run.sampling,
        flow_stress=flow,
        time=float(np.exp(material.log_time(np.array([rate]))[0])),
        drop=drop if any(test.programme.kind == "loops" for test in tests) else 0.0,
    )
    return Design(material, tuple(tests), draw_errors(random), scatter, replicates, setting)


def _draw_specimen(random: Generator, scatter: Specimen | None) -> Specimen:
    if scatter is None:
        return Specimen()
    return Specimen(
        *(
            random.normal(0.0, deviation)
            for deviation in (scatter.modulus, scatter.time, scatter.hardening, scatter.area)
        )
    )


def _draw_programmes(
    random: Generator,
    material: Material,
    rate: float,
    strain: float,
    drop: float,
    *,
    unloading: bool,
    replicated: bool,
) -> list[Programme]:
    """Ramps at two to four rates first; without a companion relation these lie close, as stresses go with them."""
    wide = material.companion is not None
    spread = 10.0 ** random.uniform(0.6, 1.1) if wide else random.uniform(1.8, 3.5)
    number = int(random.integers(2, 4 if replicated else 5))
    rates = rate * spread ** np.linspace(-0.5, 0.5, number)
    found = [ramp(float(each), strain * random.uniform(0.8, 1.0)) for each in rates]
    others = ["jumps", "grip"] if wide else ["loops", "relaxation", "jumps", "grip"]
    most = 4 if replicated else 9
    count = int(random.integers(max(3, number), most + 1)) - number if number < most else 0
    kinds = [str(random.choice(others)) for _ in range(count)]
    if unloading and "loops" not in kinds:
        kinds = ["loops", *kinds[1:]]
    for kind in kinds:
        far = strain * random.uniform(0.6, 1.0)
        if kind == "jumps":
            order = random.permutation(rates)[: max(2, min(number, 3))]
            found.append(jumps(tuple(float(each) for each in (*order, order[0])), far))
        elif kind == "grip":
            found.append(grip(rate * random.uniform(0.5, 0.9), far, random.uniform(3.0, 7.0) if wide else 2.5))
        elif kind == "loops":
            found.append(loops(rate, far, drop, int(random.integers(2, 5))))
        else:
            found.append(relaxation(rate, far * random.uniform(0.3, 1.0), strain / rate * random.uniform(0.5, 1.5)))
    return found[:9]
