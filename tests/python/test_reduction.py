"""Fewer modes: the stated error against a solve that shares nothing with the refit or the engine's schemes."""

from itertools import pairwise

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import Campaign, InputError, Law, Spectrum, Weissenberg, fit, reduce_spectrum
from probation.law.settings import LawSettings
from probation.published.experiments import experiment

E_U, G = 3220.0, 2.5
RAMP_TO_ONE = ((1.0, 1.0),)
JUMP_UP = ((1.0, 0.1), (10.0, 0.3), (1.0, 0.2))
UNLOADING = ((1.0, 0.5), (-1.0, 0.1), (1.0, 0.4), (-10.0, 0.2))


def modal_solve(spectrum, program, rate, tau_max_at):
    """Eq. (6) segment by segment: constant rate, so that e^{2e} and e^{-e} are exponentials of time.

    Returns the stress [MPa], the reduced time and the largest Weissenberg number so far, 25 times in each segment.
    """
    weight, strain, reduced, largest = spectrum.modal_weight, 0.0, 0.0, 0.0
    modal = np.zeros_like(weight)
    rows = []
    for relative_rate, extent in program:
        speed = relative_rate * rate
        tau_max = tau_max_at(abs(speed))
        tau = tau_max * spectrum.relaxation_ratio
        largest = max(largest, abs(speed) * tau_max)
        duration = extent / abs(speed)
        for t in duration * np.geomspace(1e-4, 1.0, 25):
            fading = np.exp(-t / tau)
            flow = E_U * speed * tau * (1.0 - fading)
            rising = np.exp(2.0 * strain) * (np.exp(2.0 * speed * t) - fading) / (1.0 + 2.0 * speed * tau)
            falling = np.exp(-strain) * (np.exp(-speed * t) - fading) / (1.0 - speed * tau)
            now = fading * modal + weight * (flow + G * (rising - falling))
            rows.append((now.sum(), reduced + t / tau_max, largest))
        modal, strain, reduced = now, strain + speed * duration, reduced + duration / tau_max
    return np.array(rows).T


def viscous_ramp(spectrum, reduced, weissenberg):
    """E_u We sum_j p_j r_j (1 - e^{-x/r_j}): what the stated error is a fraction of [MPa]."""
    ratio = spectrum.relaxation_ratio
    return E_U * weissenberg * ((1.0 - np.exp(-reduced[:, None] / ratio)) * ratio @ spectrum.modal_weight)


@pytest.mark.parametrize("program", [RAMP_TO_ONE, JUMP_UP, UNLOADING], ids=["ramp", "jump", "unloading"])
@pytest.mark.parametrize("accuracy", [1e-2, 1e-4])
@pytest.mark.parametrize("companion", [None, Weissenberg(0.00464, 0.0367)], ids=["constant", "companion"])
def test_the_error_is_within_what_is_stated_over_seven_decades_of_rate(accuracy, program, companion):
    whole, found = Spectrum.log_spaced(), reduce_spectrum(accuracy=accuracy)
    assert found.error <= accuracy
    for rate in 10.0 ** np.arange(-6.0, 1.5, 1.4):

        def tau_max_at(speed):
            return 5.2 if companion is None else companion.relaxation_time([speed])[0]

        stress, reduced, weissenberg = modal_solve(whole, program, rate, tau_max_at)
        fewer = modal_solve(found.spectrum, program, rate, tau_max_at)[0]
        allowed = found.error * viscous_ramp(whole, reduced, weissenberg)
        assert (np.abs(fewer - stress) <= 1.01 * allowed + 1e-9 * np.abs(stress).max()).all()


def test_the_error_is_not_far_below_what_is_stated():
    """The bound is reached where the strain turns at every change of sign of the difference; a ramp takes a part."""
    found = reduce_spectrum(accuracy=1e-3)
    reduced = np.geomspace(1e-9, 30.0, 20000)
    whole = viscous_ramp(Spectrum.log_spaced(), reduced, 1.0)
    ramp = np.abs(viscous_ramp(found.spectrum, reduced, 1.0) - whole) / whole
    assert_allclose(ramp.max(), found.ramp_error, rtol=1e-2)
    assert found.ramp_error < found.error < 20.0 * found.ramp_error


def flow_fraction(modes):
    """sum p_j r_j of eqs. (4), (5), d = 6, from two geometric sums in q = 10^(-6/(N - 1))."""
    root = 10.0 ** (-3.0 / (modes - 1))
    return (1.0 - root ** (3 * modes)) / (1.0 - root**3) * (1.0 - root) / (1.0 - root**modes)


def test_unrelaxed_modulus_and_flow_stress_are_kept():
    """sum p_j = 1 and sum p_j r_j = 0.382 (N = 50); without a refit 25 modes shift the latter by 13 %."""
    few = Spectrum.log_spaced().reduced(modes=9)
    assert_allclose(few.modal_weight.sum(), 1.0, rtol=1e-12)
    assert_allclose(few.modal_weight @ few.relaxation_ratio, flow_fraction(50), rtol=1e-6)
    naive = Spectrum.log_spaced(modes=25)
    assert_allclose(naive.modal_weight @ naive.relaxation_ratio, flow_fraction(25), rtol=1e-12)
    assert_allclose(flow_fraction(25) / flow_fraction(50), 1.13, atol=5e-3)


def test_more_modes_are_never_worse_and_no_more_than_asked_for():
    found = [reduce_spectrum(modes=modes) for modes in (1, 2, 4, 8, 25)]
    assert [each.modes for each in found[:4]] == [1, 2, 4, 8]
    assert found[4].modes <= 25
    assert all(fine.error < coarse.error for coarse, fine in pairwise(found))


def test_a_spectrum_that_needs_all_its_modes_keeps_them():
    few = Spectrum.log_spaced(modes=3)
    assert reduce_spectrum(few, accuracy=1e-5).spectrum is few
    assert reduce_spectrum(few, modes=3).spectrum is few


def test_a_refit_ends_where_modes_lie_too_far_apart_to_stand_in_for_one_another():
    sparse = Spectrum.log_spaced(modes=12, decades=40.0)
    assert reduce_spectrum(sparse, modes=11).modes <= 11


def test_other_spectra_are_met_too():
    """Five decades of equal weights, far from eq. (5)."""
    flat = Spectrum(np.geomspace(1e-5, 1.0, 60), np.full(60, 1.0 / 60.0))
    found = reduce_spectrum(flat, accuracy=1e-3)
    assert found.modes < 20
    stress, reduced, weissenberg = modal_solve(flat, JUMP_UP, 0.01, lambda speed: 5.2)
    fewer = modal_solve(found.spectrum, JUMP_UP, 0.01, lambda speed: 5.2)[0]
    assert (np.abs(fewer - stress) <= 1.01e-3 * viscous_ramp(flat, reduced, weissenberg)).all()


def test_an_identification_with_fewer_modes_finds_the_same_parameters():
    record = experiment(1).record()
    fewer = fit(Campaign("x", (record,), LawSettings(accuracy=1e-4)))
    whole = fit(Campaign("x", (record,), LawSettings()))
    assert fewer.law.modes == 12
    assert_allclose(fewer.law.parameters, whole.law.parameters, rtol=2e-4)


def test_a_campaign_keeps_its_accuracy(tmp_path):
    record = experiment(1).record()
    Campaign("x", (record,), LawSettings(accuracy=2e-3)).save(tmp_path)
    assert Campaign.load(tmp_path).law == LawSettings(accuracy=2e-3)


def test_a_law_with_fewer_modes_is_the_law():
    time = np.linspace(0.0, 100.0, 201)
    law = Law(unrelaxed_modulus=E_U, tau_max=5.2, hardening_modulus=G)
    few = law.reduced(accuracy=1e-3)
    assert few.modes == 9
    assert_allclose(few.stress(time, 0.005 * time), law.stress(time, 0.005 * time), rtol=1e-3, atol=1e-9)


@pytest.mark.parametrize(
    ("options", "complaint"),
    [
        ({}, r"accuracy and modes: found neither"),
        ({"accuracy": 1e-3, "modes": 9}, r"found both"),
        ({"accuracy": 1e-7}, r"accuracy is 1e-07; .* from 1e-05 to 0\.5"),
        ({"modes": 0}, r"modes is 0"),
    ],
)
def test_what_cannot_be_had_is_named(options, complaint):
    with pytest.raises(InputError, match=complaint):
        probation.reduce_spectrum(**options)


def test_an_accuracy_that_cannot_be_had_is_named_in_a_campaign():
    with pytest.raises(InputError, match=r"law: found accuracy = 0\.0, expected a number from 1e-05 to 0\.5"):
        LawSettings(accuracy=0.0)
