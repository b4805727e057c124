"""Small campaigns whose truth is known: ramps and one load-unload test of the base law, with a fault put in."""

from __future__ import annotations

import numpy as np

import probation
from probation.records.record import Noise, Record

NOISE = 0.04
COUNT = 150
LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
CORNERS = {
    "slow": ([0.0, 1000.0], [0.0, 1.2]),
    "middle": ([0.0, 250.0], [0.0, 1.2]),
    "fast": ([0.0, 60.0], [0.0, 1.2]),
    "unloading": ([0.0, 200.0, 260.0], [0.0, 1.0, 0.8]),
}


def few_records(
    fault=None, *, names=("slow", "middle", "fast", "unloading"), noise=NOISE, seed=1, held_out=(), count=COUNT
) -> probation.Campaign:
    """A campaign with white noise.

    `fault(name, time, strain, stress)` gives the stress that was recorded; `noise` is one level [MPa], or one each.
    """
    rng = np.random.default_rng(seed)
    records = []
    for name in names:
        instants, strains = CORNERS[name]
        time = np.linspace(0.0, instants[-1], count)
        strain = np.interp(time, instants, strains)
        stress = LAW.stress(time, strain, scheme="exact")
        if fault is not None:
            stress = fault(name, time, strain, stress)
        level = noise[name] if isinstance(noise, dict) else noise
        records.append(
            Record(
                id=name,
                time=time,
                true_strain=strain,
                true_stress=stress + level * rng.standard_normal(count),
                control="cyclic" if name == "unloading" else "strain-rate",
                role="held-out" if name in held_out else "identify",
                noise=Noise(strain=0.0),
            )
        )
    return probation.Campaign(name="few records", records=tuple(records), specimens=probation.Specimens("none"))


def offset(size, *only):
    """A force that reads `size` MPa (over the initial section) too much, in those records."""
    return lambda name, time, strain, stress: stress + size * np.exp(strain) * (name in only)


def damage(size):
    """Load-bearing area e^(-size e^2), of which neither form in the catalogue is made."""
    return lambda name, time, strain, stress: stress * np.exp(-size * np.maximum.accumulate(strain) ** 2)
