"""Histories by name."""

import numpy as np
import pytest

import probation
from probation.histories import NAMED_HISTORIES, history_from, named_history


@pytest.mark.parametrize("name", NAMED_HISTORIES)
def test_every_history_has_the_instants_asked_for_and_starts_at_zero(name):
    history = named_history(name, samples=400)
    imposed = history.true_strain if history.true_strain is not None else history.true_stress
    assert len(history) == len(imposed) == 400
    assert history.time[0] == 0.0
    assert imposed[0] == 0.0
    assert (np.diff(history.time) > 0).all()


@pytest.mark.parametrize("name", NAMED_HISTORIES)
def test_every_jump_of_the_rate_is_a_sample(name):
    history = named_history(name)
    assert set(history.jumps or ()) <= set(history.time.tolist())


def test_a_ramp_takes_strain_over_rate_seconds():
    """2 / 0.005 = 400 s."""
    assert history_from("ramp:rate=0.005,strain=2").time[-1] == 400.0


def test_a_ramp_may_compress():
    history = named_history("ramp", strain=-0.5, rate=0.01)
    assert history.true_strain[-1] == -0.5
    assert history.time[-1] == 50.0


def test_the_rate_jumps_by_the_factor_at_the_strain():
    history = named_history("rate-jump", rate=0.001, factor=10.0, jump_at=0.3, strain=0.6)
    rate = np.diff(history.true_strain) / np.diff(history.time)
    before = history.time[1:] <= history.jumps[0]
    np.testing.assert_allclose(rate[before], 0.001, rtol=1e-9)
    np.testing.assert_allclose(rate[~before], 0.01, rtol=1e-9)


def test_relaxation_holds_the_strain_with_growing_steps():
    history = named_history("relaxation", strain=0.1, rate=0.01, duration=600.0)
    hold = history.time >= 10.0
    assert (history.true_strain[hold] == 0.1).all()
    assert history.time[-1] == pytest.approx(610.0)
    steps = np.diff(history.time[hold])
    assert (np.diff(steps) > 0).all()
    assert (steps[1:] / steps[:-1]).max() < 2.41


def test_load_unload_turns_dwells_and_comes_back():
    history = named_history("load-unload", rate=0.01, strain=0.5, dwell=20.0, unload_rate=0.02, unload_to=0.4)
    assert history.jumps == (50.0, 70.0)
    assert history.time[-1] == pytest.approx(75.0)
    assert history.true_strain.max() == 0.5
    assert history.true_strain[-1] == pytest.approx(0.4)


def test_cycles_go_between_mean_plus_and_minus_amplitude():
    history = named_history("cyclic", mean=0.1, amplitude=0.05, cycles=3)
    assert history.true_strain.max() == pytest.approx(0.15)
    assert history.true_strain[history.time > 30.0].min() == pytest.approx(0.05)
    assert len(history.jumps) == 5


def test_slower_grips_give_the_same_strains_later():
    """Experiment 2 is experiment 3 at a quarter of the speed."""
    fast, slow = named_history("necking"), named_history("necking", grip_speed=0.02)
    np.testing.assert_allclose(slow.time, 4.0 * fast.time, rtol=1e-12)
    np.testing.assert_allclose(slow.true_strain, fast.true_strain, rtol=1e-12)
    np.testing.assert_allclose(4.0 * slow.strain_rate, fast.strain_rate, rtol=1e-12)


def test_creep_imposes_the_stress():
    history = named_history("creep", stress=15.0, rise=2.0, duration=100.0)
    assert history.true_strain is None
    assert history.true_stress[history.time >= 2.0] == pytest.approx(15.0)
    assert history.time[-1] == pytest.approx(102.0)


@pytest.mark.parametrize(
    ("name", "values", "told"),
    [
        ("rampp", {}, "did you mean 'ramp'"),
        ("ramp", {"speed": 1.0}, "unknown parameter 'speed'"),
        ("ramp", {"samples": 5}, "at least 10"),
        ("relaxation", {"rate": -0.1}, "above 0"),
        ("creep", {"duration": float("inf")}, "a number in s"),
    ],
)
def test_an_impossible_history_is_refused(name, values, told):
    with pytest.raises(probation.InputError, match=told):
        named_history(name, **values)


def test_a_history_imposes_strain_or_stress_not_both():
    time = np.arange(3.0)
    with pytest.raises(probation.InputError, match="exactly one"):
        probation.ImposedHistory("odd", time, true_strain=time, true_stress=time)
    with pytest.raises(probation.InputError, match="true_strain has 2 samples"):
        probation.ImposedHistory("odd", time, true_strain=time[:2])


def test_a_law_takes_a_named_history_as_it_is():
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    history = probation.named_history("load-unload")
    expected = probation.simulate(law, history, probation.SA3()).true_stress
    assert np.array_equal(law.stress(history, scheme="sa3"), expected)
    with pytest.raises(probation.InputError, match="found an imposed stress, expected a strain history"):
        law.stress(probation.named_history("creep"))
