"""A unit or a sign that was mistaken in one record is asked for."""

from dataclasses import replace

import numpy as np
import pytest

import probation
from probation import Campaign, Record, Specimens
from probation.records.unlike_others import unlike_others

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)


@pytest.fixture(scope="module")
def records():
    made = []
    for seed, rate in enumerate((0.001, 0.01, 0.1)):
        time = np.linspace(0.0, 0.5 / rate, 150)
        noise = 0.04 * np.random.default_rng(seed).standard_normal(150)
        made.append(Record(f"r{seed}", time, rate * time, LAW.stress(time, rate * time) + noise))
    return made


def test_records_at_rates_of_two_decades_are_alike(records):
    assert unlike_others(records) == ()
    assert unlike_others(records[:1]) == ()


@pytest.mark.parametrize("factor", [1e-3, 1e3])
def test_a_stress_a_thousand_times_that_of_the_others_has_another_unit(records, factor):
    one = replace(records[1], true_stress=factor * records[1].true_stress)
    [said] = unlike_others([records[0], one, records[2]])
    assert said.startswith("r1: its largest stress is ")
    assert said.endswith("is its force in another unit?")


def test_a_stress_that_pushes_while_the_specimen_is_stretched_has_the_wrong_sign(records):
    one = replace(records[1], true_stress=-records[1].true_stress)
    [said] = unlike_others([records[0], one, records[2]])
    assert said.startswith("r1: its stress and its strain have opposite signs")
    both = replace(one, true_strain=-records[1].true_strain)
    assert unlike_others([records[0], both, records[2]]) == ()


def test_a_slow_way_back_under_compression_has_no_wrong_sign():
    time = np.concatenate([np.arange(26.0), 25.0 + np.arange(1.0, 201.0)])
    strain = np.interp(time, [0.0, 25.0, 225.0], [0.0, 0.5, 0.1])
    stress = np.where(time <= 25.0, 20.0, -20.0) * (time > 0.0)
    assert unlike_others([Record("back", time, strain, stress)]) == ()


def test_a_fit_and_a_diagnosis_say_so(records):
    one = replace(records[1], true_stress=1e-3 * records[1].true_stress)
    campaign = Campaign("kN", (records[0], one, records[2]), specimens=Specimens("none"))
    fitted = probation.fit(campaign, gap=False)
    assert any("another unit" in warning for warning in fitted.warnings)
    found = probation.diagnose(campaign, effects=["force_gain"], design=False)
    assert any("another unit" in warning for warning in found.warnings)
