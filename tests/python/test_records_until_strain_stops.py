"""An extensometer that stops while the test goes on measures no hold."""

from dataclasses import replace

import numpy as np
import pytest

import probation
from probation import Campaign, Record
from probation.records.until_strain_stops import until_strain_stops

LAW = probation.Law(unrelaxed_modulus=1500.0, tau_max=8.0, hardening_modulus=2.5)


def pulled(rate=0.005, stops=np.inf, end=0.8, noise=2e-5, count=240, seed=1, sign=1.0):
    """A ramp to `end`, of which the extensometer sees no more than `stops`."""
    rng = np.random.default_rng(seed)
    time = np.linspace(0.0, end / rate, count)
    force = LAW.stress(time, sign * rate * time) * np.exp(-sign * rate * time)
    seen = sign * np.minimum(rate * time, stops)
    stress = force * np.exp(seen) + 0.04 * rng.standard_normal(count)
    return Record("r", time, seen + noise * rng.standard_normal(count), stress)


def kept(record):
    whole, note = until_strain_stops(record)
    return len(whole), note


@pytest.mark.parametrize("noise", [0.0, 2e-5, 3e-4])
@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_record_ends_where_its_strain_stops_while_the_force_goes_on(noise, sign):
    record = pulled(stops=0.5, noise=noise, sign=sign)
    count, note = kept(record)
    first = int(np.flatnonzero(record.time * 0.005 > 0.5)[0])
    assert first - 2 <= count <= first + 2
    assert f"the {240 - count} samples from there on were left out" in note
    assert "taken for an extensometer that has stopped" in note


def test_a_whole_record_stays():
    for seed in range(10):
        assert kept(pulled(seed=seed, noise=3e-4)) == (240, "")


def history(*corners, count=300):
    """A record that goes straight from corner to corner, (time, strain) each."""
    time = np.linspace(0.0, corners[-1][0], count)
    strain = np.interp(time, *np.transpose(corners))
    stress = LAW.stress(time, strain) + 0.04 * np.random.default_rng(3).standard_normal(count)
    return Record("r", time, strain, stress)


@pytest.mark.parametrize(
    "corners",
    [
        [(0.0, 0.0), (100.0, 0.5), (200.0, 0.5)],  # the stress relaxes
        [(0.0, 0.0), (100.0, 0.5), (105.0, 0.45), (200.0, 0.45)],  # it recovers after unloading
        [(0.0, 0.0), (100.0, 0.5), (101.0, 0.504), (260.0, 0.504)],
        [(0.0, 0.0), (10.0, 0.3), (400.0, 0.302)],  # slower from there on
        [(0.0, 0.0), (100.0, 0.5), (103.0, 0.5)],  # shorter than the slowest modes
    ],
)
def test_a_hold_and_a_slower_test_stay(corners):
    assert kept(history(*corners))[1] == ""


def test_a_hold_of_what_does_not_relax_stays():
    """A network alone, and metal that flows at one stress."""
    time = np.linspace(0.0, 200.0, 400)
    strain = np.minimum(0.004 * time, 0.4)
    noise = 0.01 * np.random.default_rng(5).standard_normal(400)
    for stress in (2.0 * (np.exp(2.0 * strain) - np.exp(-strain)), np.minimum(2000.0 * strain, 30.0)):
        assert kept(Record("r", time, strain, stress + noise))[1] == ""


def test_a_coarse_strain_at_a_slow_rate_stays():
    """Steps of a fiftieth: the last of them is as long as those before."""
    record = pulled(noise=0.0)
    coarse = replace(record, true_strain=np.floor(record.true_strain / 0.016) * 0.016)
    assert kept(coarse)[1] == ""


def test_a_force_that_goes_on_while_the_specimen_cools_stays():
    record = pulled(stops=0.5)
    cools = replace(record, temperature=np.linspace(80.0, 20.0, 240))
    assert kept(cools)[1] == ""


def test_a_fit_is_what_it_would_be_of_records_that_end_there():
    whole = [pulled(rate, seed=seed) for seed, rate in enumerate((0.002, 0.02))]
    records = tuple(replace(each, id=f"r{at}") for at, each in enumerate([*whole, pulled(stops=0.5, seed=7)]))
    found = probation.fit(Campaign(name="stops", records=records))
    assert found.law.hardening_modulus == pytest.approx(2.5, abs=0.02)
    assert any("r2: the strain stays at 0.5" in warning for warning in found.warnings)
