"""A machine's speed that wanders within the noise of the strain is no gap; a vibration of the force is one."""

import numpy as np
import pytest

import probation
from probation.identify.base import base_fit
from probation.identify.fit import gap_of, plain_fit

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.0)
SAMPLES, LENGTH = 400, 0.8


def campaign(strain_noise, *, wander=0.0, shake=0.0, cycles=11.0):
    """Three ramps, whose speed wanders, or whose force shakes [MPa], in the first one."""
    random = np.random.default_rng(4)
    records = []
    for name, rate in (("slow", 2e-3), ("middle", 5e-3), ("fast", 1e-2)):
        fine = np.linspace(0.0, LENGTH / rate, 10 * SAMPLES)
        turn = 2.0 * np.pi * cycles * fine * rate / LENGTH
        own = name == "slow"
        strain = rate * fine + own * wander * LENGTH * (1.0 - np.cos(turn)) / (2.0 * np.pi * cycles)
        stress = LAW.stress(fine, strain, "sa3") + own * shake * np.sin(turn)
        noise = random.standard_normal((2, SAMPLES)) * np.array([[strain_noise], [0.03]])
        records.append(probation.Record(name, fine[::10], strain[::10] + noise[0], stress[::10] + noise[1]))
    return probation.Campaign("wander", tuple(records), specimens=probation.Specimens("none"))


def test_a_wander_that_the_strain_hides_is_no_gap():
    """0.6 % of the speed: a strain of 7e-5, a seventh of its noise, and a line of 0.05 MPa in the force."""
    hidden = gap_of(campaign(5e-4, wander=6e-3))
    assert not hidden.exists
    assert hidden.test.p_value > 0.02


def test_a_vibration_of_the_force_is_a_gap_where_the_strain_would_show_a_wander():
    assert gap_of(campaign(1e-5, shake=0.06)).exists


def test_what_may_be_hidden_falls_with_the_noise_of_the_strain():
    """Half a per cent of a speed at most; of a strain that is nearly exact far less is left to wander."""
    sizes = []
    for noise in (1e-3, 1e-4, 1e-5):
        made = campaign(noise)
        record = base_fit(made, plain_fit(made)).whitened.records[0]
        sizes.append(float(np.max(np.abs(record.wander))))
    assert sizes[0] < 0.005 * float(np.max(made.records[0].true_stress))
    assert sizes[1] < 0.7 * sizes[0]
    assert sizes[2] < 0.2 * sizes[1]


def test_a_strain_as_it_was_measured_hides_nothing():
    made = campaign(0.0)
    assert base_fit(made, plain_fit(made)).whitened.records[0].wander is None


@pytest.mark.parametrize("cycles", [5.0, 20.0])
def test_other_frequencies_are_allowed_for_alike(cycles):
    assert not gap_of(campaign(5e-4, wander=4e-3, cycles=cycles)).exists
