"""How often is a prediction called missed where nothing is wrong?

`python -m bench.held_out_nulls [COUNT]`: so many simulated campaigns (100) of four tests each, two of them held out, at
each of four kinds of noise; two minutes. Prints how many were said to hold a gap in the fitted records, in the
predicted ones, and how the p-values of the predictions are distributed.
"""

from __future__ import annotations

import argparse

import numpy as np

import probation
from probation.effects.registry import effects
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.gap import find_gap
from probation.records.record import Noise, Record

LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.0)
TESTS = {
    "slow": ([0.0, 1000.0], [0.0, 1.2]),
    "middle": ([0.0, 250.0], [0.0, 1.2]),
    "fast": ([0.0, 60.0], [0.0, 1.2]),
    "unloading": ([0.0, 200.0, 260.0], [0.0, 1.0, 0.8]),
}
HELD_OUT = ("fast", "unloading")
SAMPLES, STRESS_NOISE = 300, 0.04
NOISES = ((0.0, 0.0), (0.0, 0.7), (1e-4, 0.0), (5e-4, 0.5))
"""Standard deviation of the strain, and autocorrelation of the stress noise from sample to sample."""


def null(seed: int, strain_noise: float, correlation: float) -> probation.Campaign:
    """A campaign in which the law is exact."""
    rng = np.random.default_rng(seed)
    records = []
    for name, (instants, strains) in TESTS.items():
        time = np.linspace(0.0, instants[-1], SAMPLES)
        strain = np.interp(time, instants, strains)
        noise = rng.standard_normal(SAMPLES)
        for index in range(1, SAMPLES):
            noise[index] = correlation * noise[index - 1] + np.sqrt(1.0 - correlation**2) * noise[index]
        records.append(
            Record(
                id=name,
                time=time,
                true_strain=strain + strain_noise * rng.standard_normal(SAMPLES),
                true_stress=LAW.stress(time, strain, scheme="exact") + STRESS_NOISE * noise,
                control="cyclic" if name == "unloading" else "strain-rate",
                role="held-out" if name in HELD_OUT else "identify",
                noise=Noise() if strain_noise else Noise(strain=0.0),
            )
        )
    return probation.Campaign(name="null", records=tuple(records))


def main() -> None:
    """Run."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("count", nargs="?", type=int, default=100)
    count = parser.parse_args().count
    print("strain noise  AR(1)  gap in fitted  in predicted  p < 0.05  p < 0.01")
    for strain_noise, correlation in NOISES:
        fitted, predicted, values = 0, 0, []
        for seed in range(count):
            campaign = null(seed, strain_noise, correlation)
            gap = find_gap(base_fit(campaign, plain_fit(campaign)).screened(effects()), effects())
            fitted += gap.in_fitted
            predicted += gap.in_held_out
            values += [each.p_value for each in gap.held_out.values()]
        small, smaller = (np.mean(np.array(values) < level) for level in (0.05, 0.01))
        print(f"{strain_noise:12g}  {correlation:5g}  {fitted:6d} of {count:3d}  {predicted:5d} of {count:3d}", end="")
        print(f"  {small:8.3f}  {smaller:8.3f}")


if __name__ == "__main__":
    main()
