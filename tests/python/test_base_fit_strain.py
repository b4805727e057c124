"""Which strain drives the law in a diagnosis: the recorded one only where the stress shows that it is real."""

import numpy as np
import pytest

import probation
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit

NOISE, STRAIN_NOISE, SAMPLES = 0.035, 1e-5, 300


def strains_as_recorded(modulus, wiggle, seed, strain_noise=STRAIN_NOISE, exponent=0.0):
    """Of each of two ramps, whether the base fit takes its strain as it was recorded.

    `wiggle` is what the control adds to the strain from sample to sample, which the specimen sees. The material relaxes
    faster with the rate to the power `exponent`, of which the law knows nothing.
    """
    random = np.random.default_rng(seed)
    records = []
    for rate in (1e-3, 1e-2):
        material = probation.Law(
            unrelaxed_modulus=modulus, tau_max=30.0 * (rate / 1e-3) ** -exponent, hardening_modulus=1.1
        )
        time = np.linspace(0.0, 0.4 / rate, SAMPLES)
        seen = rate * time + wiggle * np.append(0.0, random.standard_normal(SAMPLES - 1))
        recorded = seen + strain_noise * random.standard_normal(SAMPLES)
        stress = material.stress(time, seen, "sa2") + NOISE * random.standard_normal(SAMPLES)
        records.append(probation.Record(id=f"{rate:g}", time=time, true_strain=recorded, true_stress=stress))
    alike = probation.Specimens(scatter="none")
    campaign = probation.Campaign(name="strain", records=tuple(records), specimens=alike)
    base = base_fit(campaign, plain_fit(campaign, "sa3", None))
    return [view.strain_rate is None for view in base.views]


@pytest.mark.parametrize("seed", range(4))
def test_noise_of_the_strain_does_not_drive_a_law_too_soft_to_tell(seed):
    assert not any(strains_as_recorded(50.0, 0.0, seed))


@pytest.mark.parametrize("strain_noise", [5e-5, 2e-4])
@pytest.mark.parametrize("seed", range(2))
def test_noise_of_the_strain_does_not_drive_a_law_that_lacks_an_effect(seed, strain_noise):
    """Faster relaxation at the faster rate, a hundred times the noise."""
    assert not any(strains_as_recorded(1500.0, 0.0, seed, strain_noise, exponent=0.7))


@pytest.mark.parametrize("exponent", [0.0, 0.7])
def test_a_restless_control_that_the_stress_shows_drives_the_law(exponent):
    assert all(strains_as_recorded(1500.0, 3e-4, 0, exponent=exponent))
