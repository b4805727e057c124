"""Do the schemes agree with closed forms, with literal versions of themselves, and with each other?"""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.integrate import solve_ivp

import probation
from probation import Modification, SelfHeating, StressActivation
from reference import literal, paper

E_U, TAU, G = paper.E_U, paper.TAU_MAX, paper.G
SCHEMES = ("be2", "sa2", "sa3", "exact", "cvode")
PAPERS_BE2 = probation.BE2(start="backward_euler")


def law(**changed):
    return probation.Law(**({"unrelaxed_modulus": E_U, "tau_max": TAU, "hardening_modulus": G} | changed))


def experiment_1(h):
    """Ramp of 0.005 1/s to a strain of 2."""
    time = np.arange(round(400 / h) + 1) * h
    return time, 0.005 * time


# Literal versions


@pytest.mark.parametrize("start", ["uniform", "uneven"])
def test_be2_is_literally_eq_9(start):
    """z-form and sigma-form differ by rounding alone: 1e-12 MPa where both are given the same rates."""
    time = np.linspace(0.0, 400.0, 2001) if start == "uniform" else paper.uneven(1500, 400.0)
    strain, rate = 0.005 * time, np.full(len(time), 0.005)
    found = law().stress(probation.StrainHistory(time, strain, strain_rate=rate, jumps=None), scheme=PAPERS_BE2)
    assert_allclose(found, literal.be2(time, strain, E_U, G, TAU, rates=rate[1:]), rtol=0.0, atol=1e-12)


def test_be2_takes_the_three_point_backward_difference():
    """Strains are rounded: 1e-16 over h, times E_u tau, is 1e-12 MPa."""
    time = paper.uneven(500, 60.0)
    strain = paper.smooth_strain(time)
    found = law().stress(probation.StrainHistory(time, strain, jumps=None), scheme=PAPERS_BE2)
    assert_allclose(found, literal.be2(time, strain, E_U, G, TAU), rtol=0.0, atol=5e-12)


def test_be2_restarts_as_the_paper_starts():
    time = np.arange(241) * 0.25
    strain = np.where(time < 30.0, 0.005 * time, 0.15 - 0.01 * (time - 30.0))
    found = law().stress(probation.StrainHistory(time, strain, jumps=[30.0]), scheme=PAPERS_BE2)
    expected = literal.be2(time, strain, E_U, G, TAU, fresh={120})
    assert_allclose(found, expected, rtol=0.0, atol=5e-12)


def test_be2_starts_afresh_beyond_the_stable_ratio():
    """h / h0 = 3 at two places; below 2.41 BDF2 goes on."""
    steps = np.concatenate([np.full(40, 0.1), np.full(40, 0.3), np.full(20, 0.7), np.full(10, 2.1)])
    time = np.concatenate([[0.0], np.cumsum(steps)])
    strain = paper.smooth_strain(time)
    rates = literal.backward_rates(time, strain)
    found = law().stress(probation.StrainHistory(time, strain, jumps=None), scheme=PAPERS_BE2)
    expected = literal.be2(time, strain, E_U, G, TAU, fresh={40, 100}, rates=rates)
    assert_allclose(found, expected, rtol=0.0, atol=5e-12)


def test_be2_uses_the_relaxation_time_at_the_end_of_the_step():
    companion = probation.Weissenberg(*paper.WEISSENBERG)
    time = paper.uneven(300, 60.0)
    strain = paper.smooth_strain(time)
    rates = literal.backward_rates(time, strain)
    tau = 1.1 * (0.00464 * np.log10(rates) + 0.0367) / rates
    base = law(tau_max=None, alpha=1.1, companion=companion)
    found = base.stress(probation.StrainHistory(time, strain, jumps=None), scheme=PAPERS_BE2)
    assert_allclose(found, literal.be2(time, strain, E_U, G, tau), rtol=0.0, atol=5e-12)


@pytest.mark.parametrize(("scheme", "order"), [("sa2", 2), ("sa3", 3)])
@pytest.mark.parametrize("modes", [1, 2, 50])
def test_sa_schemes_are_literally_their_recursions(scheme, order, modes):
    """In q and s as docs/law.md writes them, coefficients in 40 digits; a jump, uneven steps."""
    time = np.concatenate([np.linspace(0.0, 6.0, 13), 6.0 + paper.uneven(30, 20.0)[1:]])
    strain = np.where(time < 6.0, 0.004 * time, 0.024 + paper.smooth_strain(time - 6.0))
    found = law(modes=modes).stress(probation.StrainHistory(time, strain, jumps=[6.0]), scheme=scheme)
    expected = literal.sa(time, strain, E_U, G, TAU, order=order, modes=modes, fresh={12})
    assert_allclose(found, expected, rtol=0.0, atol=1e-12)


@pytest.mark.parametrize("companion", [None, probation.Weissenberg(*paper.WEISSENBERG)])
@pytest.mark.parametrize("scheme", ["sa2", "sa3"])
def test_an_error_of_a_short_step_is_not_carried_on_by_the_long_one_behind_it(scheme, companion):
    """A sample read 10 ms before the next one, as a logger takes it where the speed changes; then 0.3 s between them.

    The stress that belongs to the sample is E_u times its error. SA3's parabola through the three made 30 times as much
    of it at the next sample; it is bent as in a step four times as long.
    """
    time = np.concatenate([np.arange(0.0, 6.0, 0.3), 5.99 + np.arange(0.01, 6.0, 0.3)])
    time = np.insert(time, 20, 5.99)
    strain, error = 0.004 * time, np.where(np.arange(len(time)) == 20, 1e-4, 0.0)
    base = law(tau_max=None, alpha=1.1, companion=companion) if companion else law()
    rate = np.full_like(time, 0.004)

    def stress(strain):
        history = probation.StrainHistory(time, strain, strain_rate=rate, jumps=[time[20]])
        return base.stress(history, scheme=scheme)

    moved = np.abs(stress(strain + error) - stress(strain))
    assert moved[20] == pytest.approx(1e-4 * E_U, rel=0.3)
    assert moved[21:].max() < 4e-4 * E_U


# Stated errors


@pytest.mark.parametrize(("h", "error"), [(0.5, 0.58), (0.2, 0.18), (0.1, 0.07)])
def test_the_papers_start_errs_as_physics_states(h, error):
    time, strain = experiment_1(h)
    found = law().stress(time, strain, scheme=PAPERS_BE2) - probation.ramp_stress(law(), 0.005, time)
    assert np.abs(found).max() == pytest.approx(error, abs=0.006)


@pytest.mark.parametrize("h", [0.5, 0.2, 0.1])
def test_the_exponential_start_is_about_five_times_better(h):
    time, strain = experiment_1(h)
    truth = probation.ramp_stress(law(), 0.005, time)
    worst = {
        s: np.abs(law().stress(time, strain, scheme=probation.BE2(start=s)) - truth).max()
        for s in ("exponential", "backward_euler")
    }
    assert worst["exponential"] < 0.25 * worst["backward_euler"]


def test_sa3_keeps_its_error_on_the_ramp_of_the_performance_table():
    time = np.linspace(0.0, 400.0, 2001)
    base = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
    found = base.stress(time, 0.005 * time, "sa3") - probation.ramp_stress(base, 0.005, time)
    assert np.abs(found).max() <= 2e-7


def test_cvode_keeps_its_error_on_the_ramp():
    time = np.linspace(0.0, 400.0, 2001)
    found = law().stress(time, 0.005 * time, probation.CVODE(relative_tolerance=1e-10))
    assert_allclose(found, probation.ramp_stress(law(), 0.005, time), rtol=0.0, atol=1e-6)


def several_segments():
    """Fast ramp, slow ramp, hold, unloading into compression, one step of a microsecond."""
    time = np.array([0.0, 0.5, 3.0, 3.000001, 20.0, 50.0, 51.0, 90.0])
    strain = np.array([0.03, 0.08, 0.20, 0.2000001, 0.9, 0.9, 0.4, -0.3])
    return time, strain


def test_exact_is_the_closed_form_of_every_segment():
    """Against 40 digits; stresses reach 250 MPa."""
    time, strain = several_segments()
    expected = literal.mp_segments(time, strain, E_U, G, TAU)
    assert_allclose(law().stress(time, strain, "exact"), expected, rtol=1e-13, atol=1e-12)


def test_cvode_agrees_with_exact_on_segments():
    time, strain = several_segments()
    found = law().stress(time, strain, probation.CVODE(relative_tolerance=1e-10))
    assert_allclose(found, law().stress(time, strain, "exact"), rtol=0.0, atol=1e-6)


def test_exact_and_cvode_are_the_law_as_scipy_integrates_it():
    """Eq. (6) written out again, Radau at 1e-10, companion relation (11) on every segment's own rate."""
    time, strain = np.array([0.0, 4.0, 10.0, 15.0]), np.array([0.0, 0.05, 0.08, 0.02])
    ratio, p = literal.spectrum(8, 2.0)
    state, expected = np.zeros(8), [0.0]
    for n in range(3):
        rate = (strain[n + 1] - strain[n]) / (time[n + 1] - time[n])
        tau = 1.2 * ratio * (0.00464 * np.log10(abs(rate)) + 0.0367) / abs(rate)

        def flow(t, s, n=n, rate=rate, tau=tau):
            e_ht = literal.hardening_strain(strain[n] + rate * (t - time[n]))
            return p * E_U * rate - (s - p * G * e_ht) / tau

        run = solve_ivp(flow, time[n : n + 2], state, "Radau", rtol=1e-10, atol=1e-10)
        state = run.y[:, -1]
        expected.append(state.sum())
    companion = probation.Weissenberg(*paper.WEISSENBERG)
    base = law(tau_max=None, alpha=1.2, companion=companion, modes=8, decades=2.0)
    for scheme in ("exact", "cvode"):
        assert_allclose(base.stress(time, strain, scheme), expected, rtol=0.0, atol=1e-6)


def test_sa3_and_exact_agree_on_a_smooth_ramp():
    time = np.linspace(0.0, 400.0, 2001)
    found = law().stress(time, 0.005 * time, "sa3")
    assert_allclose(found, law().stress(time, 0.005 * time, "exact"), rtol=0.0, atol=1e-6)


# Starts


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("initial", [-0.4, 0.0, 0.7])
def test_a_relaxed_start_stays_relaxed_under_hold(scheme, initial):
    """sigma(0) = G e_HT(e(0)) and nothing drives it away."""
    time = np.concatenate([[0.0], np.geomspace(1e-6, 1e4, 30)])
    found = law().stress(time, np.full(31, initial), scheme)
    assert_allclose(found, G * literal.hardening_strain(initial), rtol=1e-12, atol=1e-13)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_one_mode_held_decays_exponentially(scheme):
    """From an initial modal stress of 7 MPa at G = 0: 7 exp(-t / 2)."""
    time = np.linspace(0.0, 5.0, 501)
    base = probation.Law(unrelaxed_modulus=100.0, tau_max=2.0, hardening_modulus=0.0, modes=1)
    found = base.stress(time, np.zeros(501), scheme, modification=Modification(initial_modal_stress=[7.0]))
    assert_allclose(found, 7.0 * np.exp(-time / 2.0), rtol=0.0, atol=5e-5 if scheme == "be2" else 1e-8)


def test_a_hold_with_a_companion_relation_relaxes_at_the_floors_time():
    """Rate 0 is seen as the floor, 1e-7 1/s: tau_max = (0.00464 (-7) + 0.0367) / 1e-7 = 42200 s."""
    base = law(tau_max=None, companion=probation.Weissenberg(*paper.WEISSENBERG), modes=1)
    time = np.linspace(0.0, 1e5, 2001)
    start = np.array([5.0])
    for scheme in ("sa2", "sa3", "exact", "cvode"):
        found = base.stress(time, np.zeros(2001), scheme, modification=Modification(initial_modal_stress=start))
        assert_allclose(found, 5.0 * np.exp(-time / 42200.0), rtol=0.0, atol=1e-7)


# Every field of a change, against CVODE (and the exact solution where it has one)

FIELDS = {
    "relaxation time": lambda w: Modification(relaxation_time_factor=w),
    "modulus": lambda w: Modification(unrelaxed_modulus_factor=w),
    "hardening": lambda w: Modification(hardening_factor=w),
    "added stress": lambda w: Modification(added_relaxed_stress=3.0 * w),
    "area": lambda w: Modification(load_bearing_area=w),
    "initial stress": lambda w: Modification(initial_modal_stress=np.linspace(0.5, -0.2, 12)),
    "extra modes": lambda w: Modification(extra_modulus=[400.0, 30.0], extra_relaxation_time=[0.7, 50.0]),
    "number": lambda w: Modification(0.7, 1.1, 1.2, 0.5, 0.9),
    "all": lambda w: Modification(
        w, w[::-1], w, 2.0 * w, w, np.linspace(0.5, -0.2, 12), [400.0, 30.0], [0.7, 50.0],
        (SelfHeating(1.0, 0.01, 0.02, 0.01),),
    ),
    "activation": lambda w: Modification(feedbacks=(StressActivation(20.0),)),
    "heating": lambda w: Modification(feedbacks=(SelfHeating(1.0, 0.02, 0.03, 0.01),)),
    "both": lambda w: Modification(feedbacks=(StressActivation(20.0), SelfHeating(1.0, 0.02, 0.03, 0.01))),
}  # fmt: skip


def changed_run(field, scheme, n, companion):
    """A kinked path on n steps; the samples of a change are straight in each half."""
    time = np.linspace(0.0, 32.0, n + 1)
    strain = 0.05 + np.where(time < 16.0, 0.01 * time, 0.16 + 0.004 * (time - 16.0))
    wave = 1.0 + 0.2 * np.where(time < 16.0, time / 16.0, 2.0 - time / 16.0)
    base = law(modes=12, decades=4.0)
    if companion:
        relation = probation.Weissenberg(*paper.WEISSENBERG)
        base = law(modes=12, decades=4.0, tau_max=None, alpha=1.0, companion=relation)
    tight = probation.CVODE(relative_tolerance=1e-11, absolute_tolerance=1e-11) if scheme == "cvode" else scheme
    stress = base.stress(
        probation.StrainHistory(time, strain, jumps=[16.0]), scheme=tight, modification=FIELDS[field](wave)
    )
    return stress[:: n // 32]


@pytest.mark.parametrize("companion", [False, True], ids=["constant", "companion"])
@pytest.mark.parametrize("field", FIELDS)
def test_every_change_is_the_one_that_cvode_integrates(field, companion):
    """be2 and sa2 approach it as h^2: by Richardson, (4 f(h / 2) - f(h)) / 3, they agree within 1e-4 MPa.

    sa3 meets kinks with restarts and is compared as it is.
    """
    reference = changed_run(field, "cvode", 256, companion)
    away = np.r_[8:17, 22:33]  # well away from the start and the jump
    for scheme in ("be2", "sa2"):
        coarse, fine = (changed_run(field, scheme, n, companion) for n in (2048, 4096))
        assert_allclose(((4.0 * fine - coarse) / 3.0)[away], reference[away], rtol=0.0, atol=1e-4)
        assert np.abs(fine - reference)[away].max() < 0.01
    assert_allclose(changed_run(field, "sa3", 4096, companion)[away], reference[away], rtol=0.0, atol=2e-4)


@pytest.mark.parametrize("field", ["modulus", "added stress", "area", "initial stress", "extra modes", "number"])
def test_exact_knows_every_change_but_feedbacks(field):
    """All that it takes as straight between samples, as CVODE does: the same to CVODE's tolerance."""
    found = changed_run(field, "exact", 64, companion=False)
    assert_allclose(found, changed_run(field, "cvode", 64, companion=False), rtol=0.0, atol=1e-6)


def test_exact_refuses_a_feedback():
    with pytest.raises(probation.InputError, match="feedback"):
        changed_run("activation", "exact", 64, companion=False)


@pytest.mark.parametrize("field", ["activation", "heating", "both"])
@pytest.mark.parametrize(("scheme", "order"), [("be2", 2.0), ("sa2", 2.0), ("sa3", 2.0)])
def test_feedbacks_are_solved_within_the_step(field, scheme, order):
    """Lagged, they would fall to order 1."""
    reference = changed_run(field, "cvode", 512, companion=False)[[8, 12, 16, 24, 28, 32]]
    errors = [
        np.abs(changed_run(field, scheme, n, companion=False)[[8, 12, 16, 24, 28, 32]] - reference).max()
        for n in (256, 512, 1024)
    ]
    assert np.log2(errors[0] / errors[2]) / 2.0 > order - 0.15


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "cvode"])
def test_a_feedback_that_does_nothing_changes_nothing(scheme):
    time, strain = several_segments()
    idle = Modification(feedbacks=(StressActivation(1e9), SelfHeating(0.0, 0.0, 1.0, 1.0)))
    found, plain = (law(modes=12).stress(time, strain, scheme, modification=c) for c in (idle, None))
    assert_allclose(found, plain, rtol=1e-11, atol=1e-5 if scheme == "cvode" else 1e-9)


def test_two_changes_at_once_are_those_of_either():
    """Factors multiply, stresses add, modes and feedbacks stand side by side."""
    one = Modification(
        relaxation_time_factor=2.0, added_relaxed_stress=1.0, extra_modulus=3.0, extra_relaxation_time=4.0
    )
    two = Modification(
        relaxation_time_factor=[3.0, 4.0], added_relaxed_stress=[1.0, 2.0], extra_modulus=[5.0],
        extra_relaxation_time=[6.0], load_bearing_area=0.5, feedbacks=(StressActivation(7.0),),
    )  # fmt: skip
    both = one.and_(two)
    assert_allclose(both.relaxation_time_factor, [6.0, 8.0])
    assert_allclose(both.added_relaxed_stress, [2.0, 3.0])
    assert_allclose(both.extra_modulus, [3.0, 5.0])
    assert_allclose(both.extra_relaxation_time, [4.0, 6.0])
    assert both.load_bearing_area == 0.5
    assert both.hardening_factor is None
    assert both.feedbacks == (StressActivation(7.0),)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3", "exact", "cvode"])
def test_a_late_sample_does_not_change_what_was_before_it(scheme):
    """The clock is finer near its start than at its end: uneven steps there are not rounding."""
    chance = np.random.default_rng(0)
    time = np.append(0.0, np.cumsum(1e-6 * (1.0 + 0.3 * chance.uniform(-1.0, 1.0, 60))))
    strain = 0.3 * time / time[-1]
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=6e-5, hardening_modulus=2.0)
    alone = law.stress(probation.StrainHistory(time, strain, jumps=None), scheme=scheme)
    later = law.stress(
        probation.StrainHistory(np.append(time, 1e9), np.append(strain, strain[-1]), jumps=None), scheme=scheme
    )
    assert_allclose(later[: len(alone) - 1], alone[:-1], rtol=1e-7)
