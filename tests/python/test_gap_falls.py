"""Sudden falls of the force are read off a record; what only looks like one is not."""

from dataclasses import replace

import numpy as np
import pytest

from probation import Campaign, Law, Noise, Record
from probation.effects.falls import falls_of
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


@pytest.mark.parametrize("lasts", [0.4, 3.0, 1e6])
def test_falls_are_found_with_their_instants_and_sizes(lasts):
    found = falls_of(view(added=recovering([20.1, 50.1, 80.1], 2.0, lasts)))
    assert [fall.instant for fall in found] == pytest.approx([0.201, 0.501, 0.801], abs=0.002)
    stretch = np.exp(0.005 * np.array([20.1, 50.1, 80.1]))
    assert [fall.size for fall in found] == pytest.approx(2.0 * np.exp(-0.1 / lasts) / stretch, abs=6.0 * NOISE)


def test_noise_a_spike_and_a_rise_are_no_falls():
    spike = np.zeros(501)
    spike[200] = -3.0
    assert falls_of(view()) == ()
    assert falls_of(view(added=spike)) == ()
    assert falls_of(view(added=-recovering([50.1], 2.0, 3.0))) == ()


def test_relaxation_after_a_change_of_the_rate_is_no_fall():
    """Nearly all of the stress goes within some samples, whatever instant the record says that the rate changed."""
    held = view(((0.0, 0.0), (30.0, 0.6), (100.0, 0.6)))
    assert falls_of(held) == ()
    assert falls_of(replace(held, jumps=())) == ()


def test_what_drives_the_law_changes_no_fall():
    one = view(added=recovering([30.1, 60.1], 2.0, 3.0))
    assert falls_of(one.driven(0.9 * one.true_strain)) == falls_of(one)
