"""Sudden falls of the force are read off a record; what only looks like one is not."""

from dataclasses import replace

import numpy as np
import pytest

from probation import Campaign, Law, Noise, Record
from probation.effects.record_view import views_of
from probation.effects.sudden import falls_of, jumps_of

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


@pytest.mark.parametrize("lasts", [0.4, 3.0, 1e6])
def test_falls_are_found_with_their_instants_and_sizes(lasts):
    one = view(added=recovering([20.1, 50.1, 80.1], 2.0, lasts))
    instants, sizes = places(falls_of(one), one)
    assert falls_of(one).times == 3
    assert instants == pytest.approx([20.2, 50.2, 80.2], abs=1e-6)
    stretch = np.exp(0.005 * np.array([20.1, 50.1, 80.1]))
    assert sizes == pytest.approx(2.0 * np.exp(-0.1 / lasts) / stretch, abs=6.0 * NOISE)


def test_noise_a_spike_and_a_rise_are_no_falls():
    spike = np.zeros(501)
    spike[200] = -3.0
    assert falls_of(view()).times == 0
    assert falls_of(view(added=spike)).times == 0
    assert falls_of(view(added=-recovering([50.1], 2.0, 3.0))).times == 0


def test_relaxation_after_a_change_of_the_rate_is_no_fall():
    """Nearly all of the stress goes within some samples, whatever instant the record says that the rate changed."""
    held = view(((0.0, 0.0), (30.0, 0.6), (100.0, 0.6)))
    assert falls_of(held).times == 0
    assert falls_of(replace(held, jumps=())).times == 0


@pytest.mark.parametrize("noise", [0.0, 1e-5, 2e-4])
def test_jumps_of_the_strain_are_told_from_changes_of_its_rate(noise):
    strain = np.interp(np.linspace(0.0, 100.0, 501), [0.0, 20.0, 60.0, 100.0], [0.0, 0.3, 0.3, 0.2])
    strain += noise * np.random.default_rng(2).standard_normal(501)
    assert jumps_of(recorded(strain)).times == 0
    strain[150:] += 0.01
    strain[400:] -= 0.006
    one = recorded(strain)
    instants, sizes = places(jumps_of(one), one)
    assert instants == pytest.approx([30.0, 80.0], abs=1e-6)
    assert sizes == pytest.approx([0.01, -0.006], abs=6.0 * noise + 1e-6)


def recorded(strain):
    time = np.linspace(0.0, 100.0, 501)
    record = Record(id="one", time=time, true_strain=strain, true_stress=10.0 * strain)
    return views_of(Campaign(name="one", records=(record,)))[0]
