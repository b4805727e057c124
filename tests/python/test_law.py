"""Does a Law keep its promises: parameters, equality, copies, errors?"""

import copy
import pickle
from concurrent.futures import ProcessPoolExecutor
from dataclasses import replace
from multiprocessing import get_context

import numpy as np
import pytest

import probation
from probation import Law, Modification, SelfHeating, Spectrum, StressActivation, Weissenberg

BASE = {"unrelaxed_modulus": 3220.0, "hardening_modulus": 2.5}
TIME, STRAIN = [0.0, 50.0, 100.0], [0.0, 0.25, 0.5]
LAWS = {
    "constant": Law(**BASE, tau_max=5.2),
    "companion": Law(**BASE, alpha=1.1, companion=Weissenberg(0.00464, 0.0367)),
    "table": Law(**BASE, companion=probation.Table([1e-4, 1e-2], [100.0, 2.0])),
    "spectrum": Law(**BASE, tau_max=5.2, spectrum=Spectrum([0.1, 1.0], [0.4, 0.6])),
}
laws = pytest.mark.parametrize("law", LAWS.values(), ids=LAWS)


def solve(law):
    return law.stress(TIME, STRAIN)


@laws
@pytest.mark.parametrize("copied", [copy.copy, copy.deepcopy, lambda law: pickle.loads(pickle.dumps(law))])
def test_a_copy_is_the_same_law(law, copied):
    other = copied(law)
    assert other == law
    assert hash(other) == hash(law)
    assert np.array_equal(solve(other), solve(law))
    with pytest.raises(ValueError, match="read-only"):
        other.spectrum.modal_weight[0] = 1.0


def test_laws_travel_to_other_processes():
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        found = list(pool.map(Law.stress, LAWS.values(), [TIME] * 4, [STRAIN] * 4))
    assert all(np.array_equal(one, solve(law)) for one, law in zip(found, LAWS.values(), strict=True))


def test_feedbacks_are_values():
    """Equal if their parameters are; they and the changes that hold them can be copied."""
    feedbacks = (StressActivation(15.0), SelfHeating(1.0, 0.0, 0.02, 0.01))
    assert pickle.loads(pickle.dumps(feedbacks)) == feedbacks
    assert hash(copy.deepcopy(feedbacks[1])) == hash(feedbacks[1])
    assert StressActivation(15.0) != StressActivation(16.0)
    assert StressActivation(15.0) != "StressActivation(15.0)"
    assert repr(feedbacks[1]) == "SelfHeating(1.0, 0.0, 0.02, 0.01)"
    assert eval(repr(feedbacks[0]), {"StressActivation": StressActivation}) == feedbacks[0]
    change = copy.deepcopy(Modification(hardening_factor=[1.0, 2.0, 3.0], feedbacks=feedbacks))
    assert change.feedbacks == feedbacks


def test_a_convergence_error_keeps_its_attributes_when_pickled():
    with pytest.raises(probation.ConvergenceError) as raised:
        LAWS["constant"].stress(TIME, STRAIN, probation.CVODE(max_steps=1))
    again = pickle.loads(pickle.dumps(raised.value))
    assert (again.time, again.residual_norm) == (raised.value.time, raised.value.residual_norm)
    assert str(again) == str(raised.value)


def test_a_spectrum_is_equal_by_value():
    assert Spectrum.log_spaced() == Spectrum.log_spaced(50, 6.0)
    assert hash(Spectrum.log_spaced()) == hash(Spectrum.log_spaced(50, 6.0))
    assert Spectrum.log_spaced(49) != Spectrum.log_spaced(50)
    assert Spectrum([1.0], [1.0]) != ([1.0], [1.0])
    assert Law(**BASE, tau_max=5.2) == Law(**BASE, tau_max=np.float64(5.2), modes=np.int64(50))


def test_the_papers_spectrum():
    """docs/law.md: sum p_j tau_j / tau_max is 0.382 at N = 50; eq. (4): 10^(6/49) from mode to mode."""
    spectrum = Spectrum.log_spaced()
    assert spectrum.modal_weight.sum() == pytest.approx(1.0, rel=1e-15)
    assert (spectrum.modal_weight * spectrum.relaxation_ratio).sum() == pytest.approx(0.382, abs=5e-4)
    assert np.diff(np.log10(spectrum.relaxation_ratio)) == pytest.approx(np.full(49, 6.0 / 49.0), rel=1e-12)
    assert spectrum.relaxation_ratio[[0, -1]] == pytest.approx([1e-6, 1.0], rel=1e-14)


def test_a_spectrum_of_its_own_says_how_many_modes_it_has():
    assert LAWS["spectrum"].modes == 2


@laws
def test_other_parameters_leave_the_rest(law):
    """With alpha or tau_max in second place."""
    other = law.with_parameters([1000.0, 2.0, 3.0])
    assert other.parameters == pytest.approx([1000.0, 2.0, 3.0])
    assert (other.companion, other.spectrum) == (law.companion, law.spectrum)
    assert other.with_parameters(law.parameters) == law
    assert other.parameter_names[1] == ("tau_max" if law.companion is None else "alpha")


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({}, r"tau_max is missing"),
        ({"tau_max": 1.0, "alpha": 1.0}, r"alpha is given without a companion"),
        ({"tau_max": 1.0, "companion": Weissenberg(0.1, 1.0)}, r"tau_max and companion are both given"),
        ({"tau_max": 0.0}, r"tau_max is 0; a positive time"),
        ({"tau_max": -1.0}, r"tau_max is -1"),
        ({"tau_max": np.nan}, r"tau_max is nan"),
        ({"tau_max": np.inf}, r"tau_max is inf"),
        ({"tau_max": "5"}, r"tau_max is '5'; a number"),
        ({"tau_max": True}, r"tau_max is True; a number"),
        ({"tau_max": 10**400}, r"tau_max is too large"),
        ({"tau_max": np.array(5.0)}, r"tau_max is array\(5.\)"),
        ({"alpha": 0.0, "companion": Weissenberg(0.1, 1.0)}, r"alpha is 0"),
        ({"tau_max": 1.0, "unrelaxed_modulus": -1.0}, r"unrelaxed_modulus is -1"),
        ({"tau_max": 1.0, "hardening_modulus": np.nan}, r"hardening_modulus is nan"),
        ({"companion": 5}, r"companion is 5; expected a Companion"),
        ({"companion": Weissenberg}, r"expected a Companion"),
        ({"tau_max": 1.0, "spectrum": [1.0]}, r"spectrum is \[1.0\]; expected a Spectrum"),
        ({"tau_max": 1.0, "modes": 0}, r"modes is 0"),
        ({"tau_max": 1.0, "modes": 2.5}, r"modes is 2.5"),
        ({"tau_max": 1.0, "modes": 10**12}, r"modes is 1000000000000"),
        ({"tau_max": 1.0, "decades": 0.0}, r"decades is 0"),
        ({"tau_max": 1.0, "decades": np.nan}, r"decades is nan"),
    ],
)
def test_a_law_that_cannot_be_is_refused(wrong, message):
    with pytest.raises(probation.InputError, match=message):
        Law(**(BASE | wrong))


@pytest.mark.parametrize(
    ("values", "message"),
    [([1.0, 2.0], r"values has 2 entries; expected unrelaxed"), ([1.0, np.nan, 1.0], r"values\[1\]")],
)
def test_parameters_that_cannot_be_are_refused(values, message):
    with pytest.raises(probation.InputError, match=message):
        LAWS["constant"].with_parameters(values)


@pytest.mark.parametrize(
    ("ratio", "weight", "message"),
    [
        ([], [], r"no modes"),
        ([1.0], [1.0, 2.0], r"modal_weight has 2 entries, relaxation_ratio 1"),
        ([0.0], [1.0], r"relaxation_ratio"),
        ([1.0], [-1.0], r"modal_weight"),
        ([np.nan], [1.0], r"relaxation_ratio\[0\] is nan"),
        (1.0, 1.0, r"relaxation_ratio has the shape \(\)"),
    ],
)
def test_a_spectrum_that_cannot_be_is_refused(ratio, weight, message):
    with pytest.raises(probation.InputError, match=message):
        Spectrum(ratio, weight)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: StressActivation(0.0), r"activation_stress"),
        (lambda: StressActivation(np.nan), r"activation_stress"),
        (lambda: StressActivation(np.inf), r"activation_stress"),
        (lambda: SelfHeating(np.nan, 0.0, 1.0, 1.0), r"heating must"),
        (lambda: SelfHeating(1.0, -1.0, 1.0, 1.0), r"cooling_rate"),
        (lambda: SelfHeating(1.0, np.inf, 1.0, 1.0), r"cooling_rate"),
        (lambda: SelfHeating(1.0, 0.0, np.inf, 1.0), r"softening"),
        (lambda: SelfHeating(1.0, 0.0, 1.0, np.nan), r"hardening_loss"),
    ],
)
def test_a_feedback_that_cannot_be_is_refused(make, message):
    with pytest.raises(probation.InputError, match=message):
        make()


# A history is an object or two arrays

WAVY_TIME = np.linspace(0.0, 20.0, 41)
WAVY_STRAIN = 0.02 * WAVY_TIME + 0.01 * np.sin(WAVY_TIME)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "exact", "cvode"])
def test_a_history_object_is_its_two_arrays(scheme):
    law, history = LAWS["constant"], probation.StrainHistory(WAVY_TIME, WAVY_STRAIN)
    assert np.array_equal(law.stress(history, scheme=scheme), law.stress(WAVY_TIME, WAVY_STRAIN, scheme=scheme))


def test_a_history_object_keeps_what_it_was_made_of():
    rate = np.gradient(WAVY_STRAIN, WAVY_TIME)
    made = probation.StrainHistory(
        WAVY_TIME, WAVY_STRAIN, strain_rate=rate, jumps=[WAVY_TIME[5]], direction=np.ones(len(WAVY_TIME) - 1)
    )
    for history in (made, pickle.loads(pickle.dumps(made))):
        assert np.array_equal(history.time, WAVY_TIME)
        assert np.array_equal(history.true_strain, WAVY_STRAIN)
        assert np.array_equal(history.strain_rate, rate)
        assert np.array_equal(history.direction, np.ones(len(WAVY_TIME) - 1))
        assert history.jumps == (5,)


@pytest.mark.parametrize("scheme", [probation.BE2, probation.SA2, probation.SA3])
@pytest.mark.parametrize("rates", [False, True], ids=["lines", "cubics"])
def test_substeps_are_steps_on_the_refined_history(scheme, rates):
    law = LAWS["constant"]
    wave = 1.0 + 0.1 * np.sin(np.linspace(0.0, 3.0, len(WAVY_TIME)))
    rate = np.gradient(WAVY_STRAIN, WAVY_TIME) if rates else None
    history = probation.StrainHistory(WAVY_TIME, WAVY_STRAIN, strain_rate=rate, jumps=None)
    change = probation.Modification(relaxation_time_factor=wave)
    fine = history.refined(4)
    finer = probation.Modification(relaxation_time_factor=np.interp(fine.time, WAVY_TIME, wave))
    expected = law.sensitivity(fine, scheme=scheme(), modification=finer)
    stress, sensitivity = law.sensitivity(history, scheme=scheme(substeps=4), modification=change)
    np.testing.assert_allclose(stress, expected[0][::4], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(sensitivity, expected[1][::4], rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(law.stress(history, scheme=scheme(substeps=4), modification=change), stress, rtol=1e-12)


def test_substeps_bring_the_scheme_to_the_exact_answer():
    law, exact = LAWS["constant"], LAWS["constant"].stress(WAVY_TIME, WAVY_STRAIN, "exact")
    once, often = (np.abs(law.stress(WAVY_TIME, WAVY_STRAIN, probation.SA2(substeps=n)) - exact).max() for n in (1, 8))
    assert often < 0.05 * once


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3"])
def test_an_answer_follows_its_input_alone_whatever_was_computed_before(scheme):
    law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    time = np.cumsum(np.random.default_rng(1).uniform(0.1, 0.3, 60))
    strain = 0.004 * time + 0.01 * np.sin(time / 3.0)
    before = law.stress(time, strain, scheme)
    steps_that_fill_the_tables = np.cumsum(np.sort(np.random.default_rng(2).uniform(0.08, 0.35, 4000)))
    law.stress(steps_that_fill_the_tables, 1e-4 * steps_that_fill_the_tables, scheme)
    assert (law.stress(time, strain, scheme) == before).all()


MODIFIED = {
    "rate shift": probation.Modification(rate_shift=probation.RateShift(0.4, 0.1, 5e-3)),
    "weights": probation.Modification(weight_exponent=-0.2),
    "start": probation.Modification(
        initial_stress=probation.InitialStress(4.0, 0.1), hardening_factor=1.5, added_relaxed_stress=0.7
    ),
}


@pytest.mark.parametrize("name", ["constant", "companion"])
def test_a_rate_shift_is_another_companion_relation(name):
    law = LAWS[name]

    def shifted(rate):
        base = law.tau_max if law.companion is None else law.companion.relaxation_time(rate)
        return base * (rate / 5e-3) ** -0.4

    other = replace(law, tau_max=None, companion=probation.RateFunction(shifted, between=(1e-4, 1e-1)))
    modification = probation.Modification(rate_shift=probation.RateShift(0.4, 0.0, 5e-3))
    strain = [0.0, 0.1, 0.5]
    found = law.stress(TIME, strain, modification=modification)
    np.testing.assert_allclose(found, other.stress(TIME, strain), rtol=1e-3)
    assert not np.allclose(found, law.stress(TIME, strain), rtol=1e-2)


def test_a_weight_exponent_is_another_spectrum_of_the_same_sum():
    law = LAWS["constant"]
    ratio, weight = law.spectrum.relaxation_ratio, law.spectrum.modal_weight
    steeper = weight * ratio**-0.2
    other = replace(law, spectrum=Spectrum(ratio, steeper * weight.sum() / steeper.sum()))
    found = law.stress(TIME, STRAIN, modification=MODIFIED["weights"])
    np.testing.assert_allclose(found, other.stress(TIME, STRAIN), rtol=1e-12)


@laws
def test_a_start_under_stress_is_carried_by_the_modes_that_have_not_relaxed(law):
    strain = [0.1, 0.25, 0.5]
    weight, held = law.spectrum.modal_weight, law.spectrum.modal_weight * np.exp(-0.1 / law.spectrum.relaxation_ratio)
    relaxed = 1.5 * law.hardening_modulus * float(probation.haward_thackray_strain(strain)[0]) + 0.7
    modal = probation.Modification(
        initial_modal_stress=relaxed * weight + 4.0 * held / held.sum(), hardening_factor=1.5, added_relaxed_stress=0.7
    )
    expected = law.stress(TIME, strain, modification=modal)
    np.testing.assert_allclose(law.stress(TIME, strain, modification=MODIFIED["start"]), expected, rtol=1e-12)


@pytest.mark.parametrize("asked", MODIFIED)
def test_sensitivities_of_a_modified_law_are_its_slopes(asked):
    law, modification = LAWS["constant"], MODIFIED[asked]
    strain = [0.1, 0.25, 0.5]  # a start whose relaxed stress follows G
    stress, found = law.sensitivity(TIME, strain, modification=modification)
    np.testing.assert_allclose(stress, law.stress(TIME, strain, modification=modification), rtol=1e-13)
    for index, value in enumerate(law.parameters):
        step = np.zeros(3)
        step[index] = 1e-5 * value
        up, down = (law.with_parameters(law.parameters + sign * step) for sign in (1.0, -1.0))
        rise = up.stress(TIME, strain, modification=modification) - down.stress(TIME, strain, modification=modification)
        np.testing.assert_allclose(found[:, index], rise / (2.0 * step[index]), rtol=1e-6, atol=1e-8)


def test_a_start_under_stress_is_refused_where_it_cannot_follow():
    start = MODIFIED["start"]
    law = LAWS["constant"]
    for call in (
        lambda: law.strain_sensitivity(TIME, STRAIN, modification=start),
        lambda: law.sensitivity(TIME, STRAIN, modification=start, directions=[probation.Direction(relaxed_stress=1.0)]),
        lambda: probation.batch.stresses(
            law, [law.parameters], probation.StrainHistory(TIME, STRAIN), modification=start
        ),
        lambda: probation.creep(law, TIME, STRAIN, modification=start),
    ):
        with pytest.raises(probation.InputError, match=r"modification: found initial_stress, which .* cannot follow"):
            call()
    with pytest.raises(probation.InputError, match="a record starts once"):
        probation.Modification(initial_stress=probation.InitialStress(1.0), initial_modal_stress=[1.0])
    with pytest.raises(probation.InputError, match="modification is 3; a Modification is needed"):
        law.stress(TIME, STRAIN, modification=3)
