"""What a machine writes after the specimen broke is no part of its record."""

from dataclasses import replace

import numpy as np
import pytest

import probation
from probation import Campaign, Record, Specimens
from probation.records.until_break import until_break

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)


def pulled(count=200, after=0, fall=1, end=0.6, seed=1):
    """A ramp; from the break on the force falls within `fall` samples to zero, and so much more is written."""
    time = np.linspace(0.0, end / 0.005, count)
    more = time[-1] + time[1] * np.arange(1, fall + after)
    stress = LAW.stress(time, 0.005 * time)
    torn = stress[-1] * np.linspace(1.0, 0.0, fall + 1)[1:]
    whole = np.concatenate([time, more])
    values = np.concatenate([stress[: len(stress)], torn, np.zeros(max(len(whole) - len(stress) - len(torn), 0))])
    noise = 0.04 * np.random.default_rng(seed).standard_normal(len(whole))
    return Record("r", whole, 0.005 * whole, values[: len(whole)] + noise)


def kept(record):
    whole, note = until_break(record)
    return len(whole), note


@pytest.mark.parametrize("after", [3, 15, 60])
@pytest.mark.parametrize("fall", [1, 3])
def test_a_record_ends_where_its_specimen_broke(after, fall):
    count, note = kept(pulled(after=after, fall=fall))
    assert count == 200
    assert note.startswith("the force falls to less than a tenth at ")
    assert note.endswith(f"the {after + fall - 1} samples from there on were left out")


def test_a_whole_record_stays():
    assert kept(pulled()) == (200, "")


def test_noise_of_the_strain_hides_no_break():
    """Three times what the strain moves by from sample to sample."""
    for seed in range(20):
        whole = pulled(count=2000, after=40, end=0.3)
        noisy = whole.true_strain + 5e-4 * np.random.default_rng(seed).standard_normal(len(whole))
        assert kept(replace(whole, true_strain=noisy))[0] == 2000


def test_a_compressive_force_that_goes_back_to_none_is_no_break():
    strain = 0.02 * np.sin(2.0 * np.pi * np.arange(401) / 40.0)
    assert kept(Record("cycles", np.arange(401.0), strain, 1500.0 * strain))[0] == 401


def test_a_force_that_is_let_go_or_relaxes_is_no_break():
    """Unloading, however fast; a hold in which a fluid relaxes within a sample; a dropout that comes back."""
    time = np.linspace(0.0, 120.0, 241)
    strain = np.interp(time, [0.0, 100.0, 102.0, 120.0], [0.0, 0.5, 0.44, 0.44])
    assert kept(Record("back", time, strain, LAW.stress(time, strain) * (time < 101.0)))[0] == 241
    held = np.minimum(0.005 * time, 0.5)
    assert kept(Record("held", time, held, 20.0 * (time < 100.5)))[0] == 241
    dropout = 20.0 * ((time < 80.0) | (time > 90.0))
    assert kept(Record("dropout", time, 0.005 * time, dropout))[0] == 241


def test_what_comes_after_a_break_is_no_gap():
    """Fifteen readings of zero were serrated flow and slip in the grips, with 98 %."""
    records = []
    for seed, (name, rate) in enumerate({"r1": 0.002, "r2": 0.005, "r3": 0.02}.items()):
        time = np.linspace(0.0, 0.6 / rate, 200)
        stress = LAW.stress(time, rate * time)
        if name == "r2":
            stress[-15:] = 0.0
        noisy = stress + 0.04 * np.random.default_rng(seed).standard_normal(200)
        records.append(Record(name, time, rate * time, noisy))
    campaign = Campaign("broken", tuple(records), specimens=Specimens("none"))
    found = probation.diagnose(campaign, design=False)
    assert found.verdict == "no_gap"
    assert any("r2: the force falls" in warning for warning in found.warnings)
    assert any("r2: the force falls" in warning for warning in probation.fit(campaign).warnings)
