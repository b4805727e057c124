"""Sudden falls of the force are read off a record; what only looks like one is not."""

from dataclasses import replace

import numpy as np
import pytest

from probation import Campaign, Law, Noise, Record
from probation.effects.record_view import views_of

LAW = Law(unrelaxed_modulus=2000.0, tau_max=5.0, hardening_modulus=2.5)
NOISE = 0.04


def view(strain_at=((0.0, 0.0), (100.0, 0.5)), added=0.0):
    """A record along straight pieces of the strain, with noise; `added` to its true stress."""
    time = np.linspace(0.0, strain_at[-1][0], 501)
    strain = np.interp(time, *zip(*strain_at, strict=True))
    stress = LAW.stress(time, strain, scheme="exact") + NOISE * np.random.default_rng(1).standard_normal(len(time))
    record = Record(id="one", time=time, true_strain=strain, true_stress=stress + added, noise=Noise(NOISE, 0.0))
    return views_of(Campaign(name="one", records=(record,)))[0]


def recovering(instants, size, lasts):
    since = np.linspace(0.0, 100.0, 501)[:, None] - np.array(instants)
    return np.where(since > 0.0, -size * np.exp(-np.maximum(since, 0.0) / lasts), 0.0).sum(axis=1)


def places(sudden, one):
    """Instants [s] at which changes are, and their sizes."""
    steps = np.diff(sudden.total)
    return one.time[1:][steps != 0.0], steps[steps != 0.0]


@pytest.mark.parametrize("lasts", [1.0, 3.0, 1e6])
def test_falls_are_found_with_their_instants_and_sizes(lasts):
    one = view(added=recovering([20.1, 50.1, 80.1], 2.0, lasts))
    instants, sizes = places(one.sudden_falls, one)
    assert one.sudden_falls.times == 3
    assert instants == pytest.approx([20.2, 50.2, 80.2], abs=1e-6)
    stretch = np.exp(0.005 * np.array([20.1, 50.1, 80.1]))
    assert sizes == pytest.approx(2.0 * np.exp(-0.1 / lasts) / stretch, abs=6.0 * NOISE)


def test_noise_a_spike_and_a_rise_are_no_falls():
    spike, dropout = np.zeros(501), np.zeros(501)
    spike[200] = -3.0
    dropout[100:103] = dropout[300:304] = -8.0
    assert view().sudden_falls.times == 0
    assert view(added=spike).sudden_falls.times == 0
    assert view(added=dropout).sudden_falls.times == 0
    assert view(added=-recovering([50.1], 2.0, 3.0)).sudden_falls.times == 0


def test_relaxation_after_a_change_of_the_rate_is_no_fall():
    """Nearly all of the stress goes within some samples, whatever instant the record says that the rate changed."""
    held = view(((0.0, 0.0), (30.0, 0.6), (100.0, 0.6)))
    assert held.sudden_falls.times == 0
    assert replace(held, jumps=()).sudden_falls.times == 0


@pytest.mark.parametrize("noise", [0.0, 1e-5, 2e-4])
def test_jumps_of_the_strain_are_told_from_changes_of_its_rate(noise):
    strain = np.interp(np.linspace(0.0, 100.0, 501), [0.0, 20.0, 60.0, 100.0], [0.0, 0.3, 0.3, 0.2])
    strain += noise * np.random.default_rng(2).standard_normal(501)
    assert recorded(strain).sudden_jumps.times == 0
    strain[150:] += 0.01
    strain[400:] -= 0.006
    one = recorded(strain)
    instants, sizes = places(one.sudden_jumps, one)
    assert instants == pytest.approx([30.0, 80.0], abs=1e-6)
    assert sizes == pytest.approx([0.01, -0.006], abs=6.0 * noise + 1e-6)


def recorded(strain):
    time = np.linspace(0.0, 100.0, 501)
    record = Record(id="one", time=time, true_strain=strain, true_stress=10.0 * strain)
    return views_of(Campaign(name="one", records=(record,)))[0]


def test_steps_of_the_readings_are_no_falls():
    """A relaxation, and a ramp, read in steps that are larger than the noise."""
    time = np.linspace(0.0, 100.0, 501)
    for stress, step in ((20.0 * np.exp(-time / 40.0), 0.1), (0.02 * time, 0.05)):
        record = Record(id="one", time=time, true_strain=1e-6 * time, true_stress=step * np.round(stress / step))
        assert views_of(Campaign(name="one", records=(record,)))[0].sudden_falls.times == 0


def test_the_force_of_a_compression_test_falls_towards_none():
    tension = view(added=recovering([20.1, 50.1], 2.0, 3.0))
    pressed = replace(tension, data=-tension.data)
    np.testing.assert_allclose(pressed.sudden_falls.total, tension.sudden_falls.total)


@pytest.mark.parametrize("kind", ["held between frames", "coarse", "commanded"])
def test_a_strain_that_goes_in_steps_has_no_jumps(kind):
    strain = np.linspace(0.0, 0.5, 501)
    if kind == "held between frames":
        strain = np.repeat(strain[::10], 10)[:501]
    elif kind == "coarse":
        strain = 0.005 * np.floor(strain / 0.005)
    else:
        strain = 0.05 * np.floor(np.linspace(0.0, 9.99, 501))
    assert recorded(strain).sudden_jumps.times == 0
