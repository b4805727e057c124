"""Each effect beside its closed form, or an independent integration of what it says."""

import math
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.integrate import cumulative_trapezoid, quad, simpson, solve_ivp
from scipy.optimize import brentq
from scipy.special import erfcx, expi

import probation
from probation.effects.catalogue.finite_extensibility import inverse_langevin
from probation.effects.catalogue.force_strain_lag import delayed
from probation.effects.cause import cause
from probation.effects.maxwell_element import maxwell_element, maxwell_element_in_strain
from probation.effects.record_view import views_of
from probation.effects.relaxation_spectra import cole_cole, stretched_exponential
from probation.inference.callable_law import CallableLaw
from probation.inference.modal_law import DnlrLaw
from probation.inference.model import CampaignModel
from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.law.modification import Modification
from probation.law.spectrum import Spectrum
from probation.published.experiments import experiment
from probation.records.record import Noise, Record

RATE = 5e-3
ONE_MODE = Spectrum([1.0], [1.0])


def ramp(rate=RATE, end=1.5, samples=400, stress=None):
    time = np.linspace(0.0, end / rate, samples)
    values = np.zeros(samples) if stress is None else stress
    return Record(id=f"ramp-{rate:g}", time=time, true_strain=rate * time, true_stress=values, noise=Noise(0.04, 0.0))


def predicted(law, record, name, form, values, substeps=1, scheme="be2", others=()):
    """The stress of one record with one effect."""
    campaign = probation.Campaign(name="closed forms", records=(record, *others))
    adapted = DnlrLaw(law) if isinstance(law, probation.Law) else law
    views = views_of(campaign, substeps=substeps, scheme=scheme)
    model = CampaignModel(adapted, views, [cause(name, form)])
    return model.predict(model.parameters(adapted.start, values))[record.id], views


def bar(modulus=1000.0):
    """An elastic bar, true stress over true strain."""
    return CallableLaw(
        lambda time, strain, parameters, modification: parameters[0] * strain,
        ("modulus_MPa",),
        (modulus,),
        (0.0,),
        (1e6,),
    )


LAW = probation.Law(unrelaxed_modulus=3000.0, tau_max=6.0, hardening_modulus=2.0)
QUICK = probation.Law(unrelaxed_modulus=1.0, tau_max=1e-3, hardening_modulus=2.0)  # in its relaxed state at all times


# --- the material ---------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("exponent", [-0.3, 0.4, 1.2])
def test_on_a_ramp_a_power_of_the_rate_is_another_time(exponent):
    """tau_max (r / r_ref)^-a, the reference between the two rates."""
    fast, slow = ramp(2e-2), ramp(1e-3)
    found, views = predicted(LAW, fast, "rate_dependent_relaxation", "power", (exponent,), others=(slow,))
    reference = views[0].reference_rate
    assert reference == pytest.approx(math.sqrt(2e-2 * 1e-3), rel=0.15)
    other = LAW.with_parameters([3000.0, 6.0 * (2e-2 / reference) ** -exponent, 2.0])
    np.testing.assert_allclose(found, other.stress(fast.time, fast.true_strain), rtol=1e-9, atol=1e-9)


def test_a_weissenberg_number_linear_in_the_logarithm_of_the_rate_is_equation_11():
    """On a necking history, where the rate changes all the time."""
    necking = experiment(3).record()
    rate = views_of(probation.Campaign(name="necking", records=(necking,)))[0].reference_rate
    number = 0.00464 * math.log10(rate) + 0.0367
    change = 0.00464 / number
    base = probation.Law(unrelaxed_modulus=3220.0, tau_max=number / rate, hardening_modulus=1.8)
    values = (1.0 - change / math.log(10.0), change)
    found, _ = predicted(base, necking, "rate_dependent_relaxation", "weissenberg", values)
    rated = probation.Law(unrelaxed_modulus=3220.0, hardening_modulus=1.8, companion=WEISSENBERG_AS_PRINTED)
    expected = rated.stress(probation.StrainHistory(necking.time, necking.true_strain, jumps=None))
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


def test_with_a_companion_relation_its_slope_changes():
    """PowerLaw(c, n) with a is PowerLaw(c r_ref^a, n - a)."""
    base = probation.Law(unrelaxed_modulus=3000.0, hardening_modulus=2.0, companion=probation.PowerLaw(0.03, -0.9))
    necking = experiment(2).record()
    found, views = predicted(base, necking, "rate_dependent_relaxation", "power", (0.07,))
    other = probation.PowerLaw(0.03 * views[0].reference_rate ** 0.07, -0.97)
    expected = probation.Law(unrelaxed_modulus=3000.0, hardening_modulus=2.0, companion=other)
    np.testing.assert_allclose(
        found,
        expected.stress(probation.StrainHistory(necking.time, necking.true_strain, jumps=None)),
        rtol=1e-10,
        atol=1e-10,
    )


@settings(max_examples=50, deadline=None)
@given(st.floats(1e-7, 1e2), st.floats(-0.5, 1.5), st.floats(-0.3, 0.5))
def test_rate_shifts_are_positive_times_with_the_slope_they_say(rate, exponent, curvature):
    """Wherever the rates roam; d ln tau / d ln r by a central difference."""
    shift = probation._core.RateShift(None, 1e-3, exponent, curvature)
    step = 1e-5
    up, down = shift.relaxation_time(np.array([rate * math.exp(step), rate * math.exp(-step)]))
    assert up > 0.0
    assert shift.log_slope(np.array([rate]))[0] == pytest.approx(math.log(up / down) / (2 * step), rel=1e-5, abs=1e-8)
    assert shift.relaxation_time(np.array([1e-3]))[0] == pytest.approx(1.0, rel=1e-14)
    assert shift.log_slope(np.array([1e-3]))[0] == pytest.approx(-exponent, rel=1e-12, abs=1e-14)


@pytest.mark.parametrize("form", ["instant", "path"])
def test_on_a_ramp_rate_dependent_hardening_is_another_modulus(form):
    fast, slow = ramp(2e-2), ramp(1e-3)
    found, views = predicted(LAW, fast, "rate_dependent_hardening", form, (0.08,), others=(slow,))
    other = LAW.with_parameters([3000.0, 6.0, 2.0 * (2e-2 / views[0].reference_rate) ** 0.08])
    np.testing.assert_allclose(found, other.stress(fast.time, fast.true_strain), rtol=1e-9, atol=1e-9)


def test_hardening_that_follows_the_rate_from_a_rate_on_is_another_modulus_on_a_ramp():
    """G ((1 + r / (b r_ref)) / (1 + 1 / b))^a; at a rate far below b r_ref nothing depends on it any more."""
    fast, slow = ramp(2e-2), ramp(1e-3)
    for record, others in ((fast, (slow,)), (slow, (fast,))):
        found, views = predicted(LAW, record, "rate_dependent_hardening", "from_a_rate", (0.2, 0.5), others=others)
        rate = record.true_strain[-1] / record.time[-1] / views[0].reference_rate
        other = LAW.with_parameters([3000.0, 6.0, 2.0 * ((1.0 + rate / 0.5) / (1.0 + 1.0 / 0.5)) ** 0.2])
        np.testing.assert_allclose(found, other.stress(record.time, record.true_strain), rtol=1e-9, atol=1e-9)
    found, _ = predicted(LAW, slow, "rate_dependent_hardening", "from_a_rate", (0.2, 1e4), others=(fast,))
    np.testing.assert_allclose(found, LAW.stress(slow.time, slow.true_strain), rtol=1e-4, atol=1e-4)


def test_relaxation_that_follows_the_rate_from_a_rate_on_has_another_time_on_a_ramp():
    """tau_max (1 + (1 / b)^a) / (1 + (r / (b r_ref))^a)."""
    fast, slow = ramp(2e-2), ramp(1e-3)
    found, views = predicted(LAW, fast, "rate_dependent_relaxation", "from_a_rate", (0.7, 3.0), others=(slow,))
    rate = 2e-2 / views[0].reference_rate
    other = LAW.with_parameters([3000.0, 6.0 * (1.0 + (1.0 / 3.0) ** 0.7) / (1.0 + (rate / 3.0) ** 0.7), 2.0])
    np.testing.assert_allclose(found, other.stress(fast.time, fast.true_strain), rtol=1e-9, atol=1e-9)


def test_a_network_built_from_a_rate_on_remembers_the_path():
    """Relaxed: half the strain at 1e-2, half at 1e-3 gives the mean of ln((1 + r / (b r_ref)) / (1 + 1 / b))."""
    time = np.concatenate([np.linspace(0, 50, 201), np.linspace(50, 550, 2001)[1:]])
    strain = np.interp(time, [0, 50, 550], [0.0, 0.5, 1.0])
    record = Record(id="jump", time=time, true_strain=strain, true_stress=0 * time, noise=Noise(0.04, 0.0))
    found, views = predicted(QUICK, record, "rate_dependent_hardening", "path_from_a_rate", (0.1, 2.0))
    parts = [(1.0 + rate / views[0].reference_rate / 2.0) / (1.0 + 1.0 / 2.0) for rate in (1e-2, 1e-3)]
    expected = 2.0 * math.sqrt(parts[0] * parts[1]) ** 0.1 * (math.e**2 - 1.0 / math.e)
    assert found[-1] == pytest.approx(expected, rel=2e-3)


FROZEN = probation.Law(unrelaxed_modulus=1000.0, tau_max=1e12, hardening_modulus=2.0, spectrum=ONE_MODE)
"""Nothing relaxes: the stress is the integral of E_u over the strain."""


def of_turned_lines(strain):
    """Mean P_2 of lines that point anywhere at first and turn with the stretch, by Simpson's rule over their cosine."""
    cosine = np.linspace(0.0, 1.0, 20001)
    along, across = cosine * np.exp(strain), np.sqrt(1.0 - cosine**2) * np.exp(-0.5 * strain)
    return simpson(1.5 * along**2 / (along**2 + across**2) - 0.5, x=cosine)


def test_a_modulus_that_grows_with_the_orientation_is_felt_step_by_step():
    found, _ = predicted(FROZEN, ramp(), "orientation", "modulus", (0.3,), substeps=4)
    np.testing.assert_allclose(found, 1000.0 * np.expm1(0.3 * ramp().true_strain) / 0.3, rtol=1e-5, atol=0.01)
    found, _ = predicted(FROZEN, ramp(), "orientation", "modulus_of_units", (0.3,), substeps=4)
    order = np.array([of_turned_lines(strain) for strain in ramp().true_strain]) / 0.6
    felt = cumulative_trapezoid(np.exp(0.3 * order), ramp().true_strain, initial=0.0)
    np.testing.assert_allclose(found, 1000.0 * felt, rtol=1e-5, atol=0.01)


@pytest.mark.parametrize(
    ("form", "measure"),
    [("relaxation_time", float), ("relaxation_time_of_units", lambda strain: of_turned_lines(strain) / 0.6)],
)
def test_times_that_grow_with_the_orientation_are_those_of_an_independent_integration(form, measure):
    """One mode: ds/dt = E_u rate - s / (tau e^(a p))."""
    law = probation.Law(unrelaxed_modulus=1000.0, tau_max=20.0, hardening_modulus=0.0, spectrum=ONE_MODE)
    record = ramp(samples=60)
    found, _ = predicted(law, record, "orientation", form, (0.8,), substeps=40)
    slope = RATE * 1000.0
    solved = solve_ivp(
        lambda t, s: slope - s / (20.0 * np.exp(0.8 * measure(RATE * t))),
        (0.0, record.time[-1]), [0.0], t_eval=record.time, rtol=1e-9, atol=1e-9,
    )  # fmt: skip
    np.testing.assert_allclose(found, solved.y[0], rtol=1e-4, atol=1e-3)


def test_a_material_that_ages_relaxes_by_its_own_clock():
    """One mode after a quick start at one strain: ln s falls by the integral of 1 / (tau (1 + t / t_e)^m)."""
    law = probation.Law(unrelaxed_modulus=1000.0, tau_max=50.0, hardening_modulus=0.0, spectrum=ONE_MODE)
    time = np.linspace(0.0, 200.0, 2001)
    strain = np.minimum(time / 0.1, 1.0) * 0.01
    held = replace(ramp(samples=2001), time=time, true_strain=strain, sha256="")
    found, _ = predicted(law, held, "ageing", "relaxation_time", (0.7, 30.0), substeps=4)
    own = lambda t: 30.0 / 0.3 * ((1.0 + t / 30.0) ** 0.3 - 1.0)  # noqa: E731
    expected = found[1] * np.exp(-(own(time[1:]) - own(0.1)) / 50.0)
    np.testing.assert_allclose(found[1:], expected, rtol=1e-3)
    stiffer, _ = predicted(FROZEN, ramp(), "ageing", "modulus", (0.1, 30.0), substeps=4)
    felt = 1000.0 * RATE * 30.0 / 1.1 * ((1.0 + ramp().time / 30.0) ** 1.1 - 1.0)
    np.testing.assert_allclose(stiffer, felt, rtol=1e-5, atol=0.01)


def test_a_network_that_relaxes_fades_with_its_time():
    """m e_HT in a Maxwell element of 50 s, by scipy, on top of the law."""
    record = ramp(samples=2001)
    found, _ = predicted(QUICK, record, "slow_process", "network", (3.0, 50.0))
    rate = record.true_strain[-1] / record.time[-1]

    def slope(t, stress):
        return 3.0 * rate * (2.0 * math.exp(2.0 * rate * t) + math.exp(-rate * t)) - stress / 50.0

    added = solve_ivp(slope, (0.0, record.time[-1]), [0.0], rtol=1e-9, atol=1e-9, t_eval=record.time).y[0]
    np.testing.assert_allclose(
        found - QUICK.stress(record.time, record.true_strain), added, atol=5e-3 * float(np.max(added))
    )


def test_a_network_built_in_time_is_there_in_the_end():
    """Relaxed: G (1 - a e^(-(t/t_c)^n)) e_HT."""
    record = ramp(1e-3, end=0.5)
    found, _ = predicted(QUICK, record, "delayed_hardening", "in_time", (0.6, 200.0, 2.0))
    t, e = record.time[-1], record.true_strain[-1]
    expected = 2.0 * (1.0 - 0.6 * math.exp(-((t / 200.0) ** 2))) * (math.exp(2.0 * e) - math.exp(-e))
    assert found[-1] == pytest.approx(expected, rel=5e-3)


def test_a_network_remembers_the_path_and_not_the_dwell():
    """Relaxed: half the strain at 1e-2, half at 1e-3 gives the geometric mean of the rates; a dwell adds nothing."""
    time = np.concatenate([np.linspace(0, 50, 201), np.linspace(50, 550, 2001)[1:], np.linspace(550, 900, 401)[1:]])
    strain = np.interp(time, [0, 50, 550, 900], [0.0, 0.5, 1.0, 1.0])
    record = Record(id="jump", time=time, true_strain=strain, true_stress=0 * time, noise=Noise(0.04, 0.0))
    found, views = predicted(QUICK, record, "rate_dependent_hardening", "path", (0.1,))
    mean = math.sqrt(1e-2 * 1e-3) / views[0].reference_rate
    expected = 2.0 * mean**0.1 * (math.e**2 - 1.0 / math.e)
    assert found[-1] == pytest.approx(expected, rel=2e-3)
    assert found[-300] == pytest.approx(expected, rel=2e-3)


def invariant(strain):
    return math.exp(2.0 * strain) + 2.0 * math.exp(-strain) - 3.0


def test_gents_network_is_haward_thackray_over_what_is_left():
    """Relaxed: G e_HT / (1 - (I_1 - 3) / J_m); at J_m = 50 and strain 1.5, I_1 - 3 = 17.53."""
    found, views = predicted(QUICK, ramp(), "finite_extensibility", "gent", (1.0 / 50.0,))
    expected = 2.0 * views[0].haward_thackray_strain[-1] / (1.0 - invariant(1.5) / 50.0)
    assert invariant(1.5) == pytest.approx(17.53, abs=0.01)
    assert found[-1] == pytest.approx(expected, rel=1e-3)


@pytest.mark.parametrize("form", ["gent", "langevin"])
def test_a_network_of_long_chains_is_haward_thackrays(form):
    """The first-order excess is G e_HT (I_1 - 3) a, and it vanishes with a."""
    law = QUICK
    base = law.stress(ramp().time, ramp().true_strain)
    found, views = predicted(law, ramp(), "finite_extensibility", form, (1e-6,))
    excess = 2.0 * views[0].haward_thackray_strain * views[0].first_invariant
    np.testing.assert_allclose((found - base)[50:] / 1e-6, excess[50:], rtol=5e-3)


def test_eight_chains_stiffen_by_langevins_function():
    """Relaxed: G e_HT (L^-1(y) / y) / (L^-1(y_0) / y_0) with y^2 = I_1 / 3N, N = 12; L^-1 by bisection."""

    def solve(y):
        return brentq(lambda x: 1.0 / math.tanh(x) - 1.0 / x - y, 1e-6, 1e6)

    links = 12.0
    y, y_0 = math.sqrt((invariant(1.5) + 3.0) / (3.0 * links)), math.sqrt(1.0 / links)
    found, views = predicted(QUICK, ramp(), "finite_extensibility", "langevin", (1.0 / (5.0 * links),))
    expected = 2.0 * views[0].haward_thackray_strain[-1] * (solve(y) / y) / (solve(y_0) / y_0)
    assert found[-1] == pytest.approx(expected, rel=1e-3)


@settings(max_examples=60, deadline=None)
@given(st.floats(1e-6, 0.95))
def test_the_inverse_of_langevins_function_is_one(y):
    x = inverse_langevin(np.array([y]))[0]
    back = x / 3.0 - x**3 / 45.0 + 2.0 * x**5 / 945.0 if x < 0.05 else 1.0 / math.tanh(x) - 1.0 / x
    assert back == pytest.approx(y, rel=1e-9)


def test_beyond_locking_the_network_goes_on_straight():
    """Finite, rising, with no step or kink where it begins (the slope is that of the curve there)."""
    for form in ("gent", "langevin"):
        found, _ = predicted(QUICK, ramp(end=2.5, samples=4000), "finite_extensibility", form, (0.02,))
        assert np.all(np.isfinite(found))
        assert np.all(np.diff(found) > 0.0)


def test_weights_follow_another_power_of_the_times():
    """After a quick stretch to 0.01 the stress is E_u e sum p_j e^(-t / tau_j), p_j ~ tau_j^0.7."""
    time = np.concatenate([[0.0, 1e-7], np.geomspace(1e-3, 50.0, 300)])
    strain = np.where(time > 0.0, 0.01, 0.0)
    record = Record(id="step", time=time, true_strain=strain, true_stress=0 * time, noise=Noise(0.04, 0.0))
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=6.0, hardening_modulus=0.0)
    found, _ = predicted(law, record, "spectrum_shape", "power", (0.2,), scheme="sa2")
    ratio = 10.0 ** (-(50.0 - np.arange(1, 51)) * 6.0 / 49.0)
    weight = ratio**0.7 / np.sum(ratio**0.7)
    expected = 30.0 * np.exp(-np.subtract.outer(time[2:], [1e-7]) / (6.0 * ratio)) @ weight
    np.testing.assert_allclose(found[2:], expected, rtol=1e-4)


def relaxation_after_a_step(form, values, part):
    """E_u e times the law's own relaxation and a part of another's, after a quick stretch to 0.01."""
    time = np.concatenate([[0.0, 1e-7], np.geomspace(1e-2, 20.0, 200)])
    strain = np.where(time > 0.0, 0.01, 0.0)
    record = Record(id="step", time=time, true_strain=strain, true_stress=0 * time, noise=Noise(0.04, 0.0))
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=6.0, hardening_modulus=0.0)
    own = law.stress(time, strain, scheme="sa2")
    found, _ = predicted(law, record, "spectrum_shape", form, (part, *values), scheme="sa2")
    return time[2:], (found - (1.0 - part) * own)[2:] / (30.0 * part)


@pytest.mark.parametrize("part", [0.3, 1.0])
def test_a_fractional_maxwell_element_relaxes_by_mittag_lefflers_function(part):
    """Of the exponent 1/2: e^z erfc(sqrt z), z = t / t_0, t_0 = 0.1 tau_max."""
    time, found = relaxation_after_a_step("cole_cole", (0.1, 0.5), part)
    np.testing.assert_allclose(found, erfcx(np.sqrt(time / 0.6)), atol=0.002)


@pytest.mark.parametrize("exponent", [0.3, 0.5, 0.8])
def test_a_stretched_exponential_relaxes_as_it_says(exponent):
    time, found = relaxation_after_a_step("stretched_exponential", (0.1, exponent), 1.0)
    np.testing.assert_allclose(found, np.exp(-((time / 0.6) ** exponent)), atol=0.002)


@pytest.mark.parametrize("distribution", [cole_cole, stretched_exponential])
def test_near_the_exponent_1_a_distribution_is_a_single_time(distribution):
    """No times below t_0, all above it; between, the part that has times up to t only grows with t."""
    np.testing.assert_allclose(distribution(np.array([0.5, 2.0]), 0.999), [0.0, 1.0], atol=2e-3)
    parts = distribution(np.geomspace(1e-12, 1e12, 500), 0.5)
    assert np.all(np.diff(parts) >= 0.0)
    np.testing.assert_allclose(parts[[0, -1]], [0.0, 1.0], atol=2e-6)


HEATING, COOLING, LOSS = 0.4, 5e-3, 0.004


def eyring(stress, _):
    x = abs(stress) / (20.0 / math.sqrt(6.0 * 0.3))
    return (x / math.sinh(x) if x > 1e-9 else 1.0), 1.0


def norton(stress, _):
    return 1.0 / (1.0 + 0.3 * (abs(stress) / 20.0) ** 3), 1.0


def warm(_, heat):
    return math.exp(-0.1 * HEATING * heat), math.exp(-LOSS * HEATING * heat)


@pytest.mark.parametrize(
    ("name", "form", "values", "shift"),
    [
        ("stress_activated_flow", "eyring", (0.3,), eyring),
        ("stress_activated_flow", "power", (0.3, 3.0), norton),
        ("self_heating", "adiabatic_to_cooled", (HEATING, COOLING, 0.1, LOSS), warm),
    ],
)
def test_feedbacks_are_those_of_an_independent_integration(name, form, values, shift):
    """One mode, by scipy at 1e-10: s' = E e' - (s - G e_HT) / tau, w' = s (e' - s'/E) - cooling w."""
    modulus, time_constant, hardening = 900.0, 4.0, 2.0
    law = probation.Law(
        unrelaxed_modulus=modulus, tau_max=time_constant, hardening_modulus=hardening, spectrum=ONE_MODE
    )
    record = ramp(samples=600)

    def slopes(t, state):
        stress, heat = state
        factor, loss = shift(stress, heat)
        strain = RATE * t
        relaxed = hardening * loss * (math.exp(2.0 * strain) - math.exp(-strain))
        rise = modulus * RATE - (stress - relaxed) / (time_constant * factor)
        return [rise, stress * (RATE - rise / modulus) - COOLING * heat]

    expected = solve_ivp(slopes, (0.0, 300.0), [0.0, 0.0], "LSODA", record.time, rtol=1e-10, atol=1e-10).y[0]
    found, _ = predicted(law, record, name, form, values, scheme="sa3", substeps=4)
    without = law.stress(record.time, record.true_strain, scheme="sa3")
    assert np.max(np.abs(expected - without)) > 0.5
    np.testing.assert_allclose(found, expected, atol=2e-3)


def test_a_late_thermometer_shows_what_the_specimen_was_before():
    """A rise of b t is read as b (t - T (1 - e^(-t/T))); it drives the law as b t does."""
    record, rate, delay = ramp(samples=600), 0.02, 15.0
    time = record.time
    late = replace(record, temperature=23.0 + rate * (time + delay * np.expm1(-time / delay)))
    found, _ = predicted(LAW, late, "self_heating", "measured_late", (0.1, 0.05, delay))
    warmed = Modification(
        relaxation_time_factor=np.exp(-0.1 * rate * time), hardening_factor=np.exp(-0.005 * rate * time)
    )
    expected = LAW.stress(time, record.true_strain, modification=warmed)
    assert np.max(np.abs(expected - LAW.stress(time, record.true_strain))) > 0.5
    np.testing.assert_allclose(found, expected, atol=2e-3)


def up_and_down():
    time = np.linspace(0.0, 300.0, 601)
    strain = np.interp(time, [0.0, 200.0, 300.0], [0.0, 1.0, 0.6])
    return Record(id="loop", time=time, true_strain=strain, true_stress=0 * time, noise=Noise(0.04, 0.0))


@pytest.mark.parametrize(
    ("form", "values", "left"),
    [
        ("saturating", (0.3, 0.4), lambda e: math.exp(-0.3 * (1.0 - math.exp(-e / 0.4)))),
        ("growing", (0.2, 1.5), lambda e: math.exp(-0.2 * e**1.5)),
        ("about_a_strain", (0.3, 0.4, 5.0), lambda e: math.exp(-0.3 * e**5 / (e**5 + 0.4**5))),
        ("beyond_a_strain", (0.3, 0.4, 0.2), lambda e: 1.0 - 0.3 * (1.0 - math.exp(-(e - 0.4) / 0.2))),
    ],
)
def test_damage_is_the_area_lost_and_stays(form, values, left):
    loop = up_and_down()
    found, _ = predicted(LAW, loop, "damage", form, values)
    ratio = found[1:] / LAW.stress(loop.time, loop.true_strain)[1:]
    assert ratio[199] == pytest.approx(left(0.5), rel=1e-9)
    np.testing.assert_allclose(ratio[-150:], left(1.0), rtol=1e-9)


def test_damage_by_the_stress_grows_as_what_the_area_left_carries():
    """30 MPa recorded all along: dD/de = a (1.5 / (1 - D))^n from 0.2 on, by scipy, at the largest strain so far."""
    loss, exponent, threshold = 0.05, 3.0, 0.2
    loop = replace(up_and_down(), true_stress=np.full(601, 30.0))
    found, _ = predicted(LAW, loop, "damage", "by_stress", (loss, exponent, threshold))
    ratio = found[1:] / LAW.stress(loop.time, loop.true_strain)[1:]
    lost = solve_ivp(lambda _, d: loss * (1.5 / (1.0 - d)) ** exponent, (0.2, 1.0), [0.0], rtol=1e-9, t_eval=[0.5, 1.0])
    assert ratio[199] == pytest.approx(1.0 - lost.y[0, 0], rel=1e-4)
    np.testing.assert_allclose(ratio[-150:], 1.0 - lost.y[0, 1], rtol=1e-4)


def test_damage_by_the_work_ends_with_it_and_none_is_done_on_the_way_back():
    """30 MPa recorded all along: the work is 30 e, e the largest strain so far."""
    loop = replace(up_and_down(), true_stress=np.full(601, 30.0))
    found, _ = predicted(LAW, loop, "damage", "by_work", (0.3, 12.0))
    ratio = found[1:] / LAW.stress(loop.time, loop.true_strain)[1:]
    assert ratio[199] == pytest.approx(math.exp(-0.3 * (1.0 - math.exp(-15.0 / 12.0))), rel=1e-6)
    np.testing.assert_allclose(ratio[-150:], math.exp(-0.3 * (1.0 - math.exp(-30.0 / 12.0))), rtol=1e-6)


def test_flow_by_the_stress_that_the_network_does_not_carry_is_quicker_by_one_factor_where_that_is_constant():
    """A recorded stress of 10 MPa above h e_HT: tau_max over 1 + a / 2^m."""
    record = ramp(samples=2001)
    stress = 10.0 + 3.0 * probation.haward_thackray_strain(record.true_strain)
    found, _ = predicted(
        LAW, replace(record, true_stress=stress), "stress_activated_flow", "beyond_the_network", (4.0, 2.0, 3.0)
    )
    quicker = LAW.with_parameters([3000.0, 3.0, 2.0])
    np.testing.assert_allclose(found, quicker.stress(record.time, record.true_strain), rtol=1e-3, atol=1e-3)


def test_an_aged_modulus_is_used_up_by_strain():
    """Times far beyond the record: the stress is the integral of E_u exp(a e^(-e / 0.1)) over the strain."""
    law = probation.Law(unrelaxed_modulus=1000.0, tau_max=1e9, hardening_modulus=0.0, modes=1, spectrum=ONE_MODE)
    record = ramp(end=0.4, samples=1001)
    found, _ = predicted(law, record, "structural_softening", "modulus", (0.5, 0.1), scheme="sa2")
    expected = quad(lambda e: 1000.0 * math.exp(0.5 * math.exp(-e / 0.1)), 0.0, 0.4)[0]
    assert found[-1] == pytest.approx(expected, rel=1e-5)


def test_an_aged_start_relaxes_more_slowly():
    """One mode by scipy with tau_max exp(a e^(-e / 0.1))."""
    law = probation.Law(unrelaxed_modulus=900.0, tau_max=4.0, hardening_modulus=2.0, spectrum=ONE_MODE)
    record = ramp(end=0.5, samples=600)

    def slope(t, stress):
        strain = RATE * t
        time_constant = 4.0 * math.exp(0.8 * math.exp(-strain / 0.1))
        return 900.0 * RATE - (stress - 2.0 * (math.exp(2.0 * strain) - math.exp(-strain))) / time_constant

    expected = solve_ivp(slope, (0.0, 100.0), [0.0], "LSODA", record.time, rtol=1e-10, atol=1e-10).y[0]
    found, _ = predicted(law, record, "structural_softening", "relaxation_time", (0.8, 0.1), scheme="sa3", substeps=4)
    np.testing.assert_allclose(found, expected, atol=2e-4)


def test_a_stress_that_falls_as_the_work_warms_is_scaled():
    """Relaxed at all times, without cooling: G e_HT (1 - a w), w the recorded work."""
    record = ramp(samples=2001)
    stress = 2.0 * probation.haward_thackray_strain(record.true_strain)
    found, _ = predicted(QUICK, replace(record, true_stress=stress), "self_heating", "of_the_stress", (0.02, 1e-5))
    strain = record.true_strain
    work = np.expm1(2.0 * strain) + 2.0 * np.expm1(-strain)
    np.testing.assert_allclose(found[200:], (stress * (1.0 - 0.02 * work))[200:], rtol=2e-3)


def test_a_slow_process_adds_a_maxwell_element():
    """M r tau (1 - e^(-t / tau)) on a ramp."""
    record = ramp()
    found, _ = predicted(LAW, record, "slow_process", "maxwell", (20.0, 400.0), scheme="sa2")
    added = found - LAW.stress(record.time, record.true_strain, scheme="sa2")
    np.testing.assert_allclose(added, -20.0 * RATE * 400.0 * np.expm1(-record.time / 400.0), atol=1e-9)


@pytest.mark.parametrize("power", [0.15, 0.4, 0.8])
def test_a_springpot_answers_a_ramp_with_a_power_of_the_time(power):
    """The integral of M (t / 100 s)^-b over a ramp is M r 100^b t^(1 - b) / (1 - b), from some samples on."""
    record = ramp()
    found, _ = predicted(LAW, record, "slow_process", "springpot", (20.0, power), scheme="sa3")
    added = found - LAW.stress(record.time, record.true_strain, scheme="sa3")
    whole = 20.0 * RATE * 100.0**power * record.time ** (1.0 - power) / (1.0 - power)
    np.testing.assert_allclose(added[20:], whole[20:], rtol=0.01)


@pytest.mark.parametrize(("form", "values", "part"), [("whole", (30.0,), 1.0), ("part", (0.4, 30.0), 0.4)])
def test_delayed_hardening_follows_with_a_first_order_lag(form, values, part):
    """Relaxed, on a ramp: y' = (e^(2rt) - e^(-rt) - y) / T has the solution below, y(0) = 0."""
    record = ramp(samples=2001)
    found, views = predicted(QUICK, record, "delayed_hardening", form, values)
    t, lag = record.time, 30.0
    grown, shrunk = 1.0 / (1.0 + 2.0 * RATE * lag), 1.0 / (1.0 - RATE * lag)
    late = grown * np.exp(2.0 * RATE * t) - shrunk * np.exp(-RATE * t) + (shrunk - grown) * np.exp(-t / lag)
    expected = 2.0 * (part * late + (1.0 - part) * views[0].haward_thackray_strain)
    np.testing.assert_allclose(found[100:], expected[100:], rtol=1e-3)


def test_hardening_that_is_delayed_in_strain_waits_for_no_time():
    """Relaxed: dy/de = (e^(2e) - e^(-e) - y) / c whatever the rate; a dwell changes nothing, nor does unloading."""
    lag = 0.3
    time = np.array([0.0, 200.0, 700.0, 900.0])
    fine = np.linspace(0.0, 900.0, 1801)
    strain = np.interp(fine, time, [0.0, 1.0, 1.0, 0.4])
    record = Record("r", fine, strain, np.zeros(1801), noise=Noise(0.04, 0.0))
    found, views = predicted(QUICK, record, "delayed_hardening", "in_strain", (lag,))
    largest = np.maximum.accumulate(strain)
    grown, shrunk = 1.0 / (1.0 + 2.0 * lag), 1.0 / (1.0 - lag)
    late = grown * np.exp(2.0 * largest) - shrunk * np.exp(-largest) + (shrunk - grown) * np.exp(-largest / lag)
    part = late[1:] / (np.exp(2.0 * largest[1:]) - np.exp(-largest[1:]))
    np.testing.assert_allclose(found[1:], 2.0 * part * views[0].haward_thackray_strain[1:], rtol=2e-3, atol=2e-3)


def test_a_network_that_is_built_with_the_fibrils_is_there_in_part_by_the_largest_strain():
    """Relaxed: G (1 - a) before, G after; at the fibrils' strain a/e of it lacks; unloading takes nothing away."""
    fine = np.linspace(0.0, 900.0, 1801)
    strain = np.interp(fine, [0.0, 700.0, 900.0], [0.0, 1.0, 0.4])
    record = Record("r", fine, strain, np.zeros(1801), noise=Noise(0.04, 0.0))
    found, views = predicted(QUICK, record, "delayed_hardening", "transition", (0.6, 0.3, 4.0))
    there = found[1:] / (2.0 * views[0].haward_thackray_strain[1:])
    rising = strain[1:1401]
    assert there[np.searchsorted(rising, 0.1)] == pytest.approx(0.4, abs=0.01)
    assert there[np.searchsorted(rising, 0.3)] == pytest.approx(1.0 - 0.6 / np.e, abs=0.005)
    np.testing.assert_allclose(there[1400:], 1.0, atol=0.002)


@pytest.mark.parametrize("relaxation_strain", [1e-5, 1e-3, 0.2, 50.0])
def test_an_element_that_relaxes_with_strain_is_a_maxwell_element_with_the_strain_for_time(relaxation_strain):
    """Also where the strain is thousands of relaxation strains long."""
    random = np.random.default_rng(2)
    strain = np.cumsum(random.uniform(1e-4, 1e-2, 300))
    values = np.cumsum(random.standard_normal(300))
    expected = maxwell_element(strain, values, relaxation_strain)
    found = maxwell_element_in_strain(strain, values, relaxation_strain)
    np.testing.assert_allclose(found, expected, rtol=1e-9, atol=1e-9)


@settings(max_examples=25, deadline=None)
@given(st.floats(1e-3, 1e4), st.integers(0, 10_000))
def test_a_maxwell_element_is_exact_between_samples(time_constant, seed):
    """By the closed form of one straight piece after another."""
    random = np.random.default_rng(seed)
    time = np.cumsum(random.uniform(0.1, 3.0, 30))
    values = np.cumsum(random.standard_normal(30))
    expected = [0.0]
    for step, rise in zip(np.diff(time), np.diff(values), strict=True):
        decay = math.exp(-step / time_constant)
        expected.append(decay * expected[-1] - rise / step * time_constant * math.expm1(-step / time_constant))
    np.testing.assert_allclose(maxwell_element(time, values, time_constant), expected, rtol=1e-9, atol=1e-12)


# --- the rig --------------------------------------------------------------------------------------------------------


def faulty(name, form, values, record=None, law=None):
    record = record or ramp(end=1.0)
    found, _ = predicted(law or bar(), record, name, form, values)
    return found, record.time, record.true_strain


def test_an_offset_of_the_force_grows_with_the_stretch():
    """F / A_0 e^strain: 0.5 MPa becomes 1.36 MPa at a strain of 1."""
    found, _, strain = faulty("force_offset", "constant", (0.5,))
    np.testing.assert_allclose(found - 1000.0 * strain, 0.5 * np.exp(strain), rtol=1e-10)
    assert (found - 1000.0 * strain)[-1] == pytest.approx(1.359, abs=1e-3)


def test_a_drift_of_the_force_reaches_its_size_at_the_end():
    found, time, strain = faulty("force_drift", "over_record", (0.8,))
    np.testing.assert_allclose(found - 1000.0 * strain, 0.8 * time / time[-1] * np.exp(strain), atol=1e-10)
    found, time, strain = faulty("force_drift", "in_time", (2e-3,))
    np.testing.assert_allclose(found - 1000.0 * strain, 2e-3 * time * np.exp(strain), atol=1e-10)


def test_a_drift_of_the_force_settles():
    """By ln(1 + t / t_0): half of it after (sqrt(1 + 1 / x) - 1) x of the record, x = t_0 over its duration."""
    found, time, strain = faulty("force_drift", "logarithmic", (0.6, 0.01))
    drift = found * np.exp(-strain)
    drift -= faulty("force_drift", "logarithmic", (0.0, 0.01))[0] * np.exp(-strain)
    assert drift[-1] == pytest.approx(0.6, rel=1e-9)
    half = 0.01 * (math.sqrt(101.0) - 1.0) * time[-1]
    assert np.interp(half, time, drift) == pytest.approx(0.3, rel=1e-3)


def test_a_wrong_section_is_a_factor():
    found, _, strain = faulty("force_gain", "factor", (-0.03,))
    np.testing.assert_allclose(found, 970.0 * strain, rtol=1e-12)


def test_a_cell_whose_characteristic_bends_reads_a_square_of_the_force():
    """By 2 % more at a nominal stress of 10 MPa, in any record."""
    found, _, strain = faulty("force_gain", "characteristic", (0.02, 1.0))
    nominal = 1000.0 * strain * np.exp(-strain)
    np.testing.assert_allclose(found, 1000.0 * strain * (1.0 + 0.002 * nominal), rtol=1e-10, atol=1e-10)


def test_a_wrong_gauge_length_is_a_factor_of_the_elongation():
    """1.04 times the elongation was recorded; the true stress was made of the force and the recorded strain."""
    found, _, strain = faulty("strain_gain", "factor", (0.04,))
    seen = np.log1p(np.expm1(strain) / 1.04)
    np.testing.assert_allclose(found, 1000.0 * seen * np.exp(strain - seen), rtol=1e-10, atol=1e-10)


def test_a_true_strain_that_was_a_rate_times_the_time_errs_as_the_rate_does():
    found, _, strain = faulty("strain_gain", "true_strain", (0.05,))
    np.testing.assert_allclose(found, 1000.0 * strain / 1.05 * np.exp(strain * 0.05 / 1.05), rtol=1e-10, atol=1e-10)


def test_a_characteristic_of_an_extensometer_bends():
    """By its square: 2 % at half of the largest elongation, 4 % at all of it."""
    found, _, strain = faulty("strain_gain", "bending", (0.04, 1.0))
    elongation = np.expm1(strain)
    seen = np.log1p(elongation / (1.0 + 0.04 * elongation / elongation[-1]))
    np.testing.assert_allclose(found, 1000.0 * seen * np.exp(strain - seen), rtol=1e-10, atol=1e-10)


@settings(max_examples=40, deadline=None)
@given(st.floats(-5.0, 5.0), st.integers(0, 1000))
def test_a_straight_signal_is_delayed_by_rate_times_delay(delay, seed):
    """Exactly, on any grid, but before the start, where there is nothing to be late."""
    time = np.cumsum(np.random.default_rng(seed).uniform(0.1, 2.0, 60))
    found = delayed(time, 3.0 + 0.7 * time, delay)
    expected = 3.0 + 0.7 * np.maximum(time - delay, time[0])
    np.testing.assert_allclose(found, expected, rtol=1e-12, atol=1e-12)


def test_a_smooth_signal_is_delayed_to_the_third_order():
    time = np.linspace(0.0, 10.0, 401)
    late = delayed(time, np.sin(time), 0.4137)
    np.testing.assert_allclose(late[20:], np.sin(time - 0.4137)[20:], atol=3e-6)


def test_a_late_force_is_that_of_an_earlier_strain():
    """Nominal stress K t: the true stress is K (t - lag) e^(strain now)."""
    law = CallableLaw(
        lambda time, strain, parameters, modification: parameters[0] * time * np.exp(strain),
        ("k",),
        (0.2,),
        (0.0,),
        (9.0,),
    )
    found, time, strain = faulty("force_strain_lag", "delay", (1.7,), law=law)
    np.testing.assert_allclose(found, 0.2 * np.maximum(time - 1.7, 0.0) * np.exp(strain), atol=1e-9)


def test_a_filtered_force_is_a_ramp_behind_by_its_time_constant():
    """F = k t through a filter of first order: k (t - c (1 - e^(-t / c)))."""
    law = CallableLaw(
        lambda time, strain, parameters, modification: parameters[0] * time * np.exp(strain),
        ("k",),
        (0.2,),
        (0.0,),
        (9.0,),
    )
    found, time, strain = faulty("force_strain_lag", "filter", (1.7, 1.0), law=law)
    expected = 0.2 * (time + 1.7 * np.expm1(-time / 1.7))
    np.testing.assert_allclose(found, expected * np.exp(strain), atol=1e-9)
    late, *_ = faulty("force_strain_lag", "delay", (1.7,), law=law)
    np.testing.assert_allclose(found[-100:], late[-100:], rtol=1e-4)


def strip(lost):
    """An elastic bar whose recorded strain is `lost(nominal stress)` more than its own, as a record."""
    seen = np.linspace(0.0, 0.3, 2000)
    nominal = 1000.0 * seen * np.exp(-seen)
    strain = seen + lost(nominal)
    return seen, Record(
        id="strip", time=np.arange(2000.0), true_strain=strain, true_stress=nominal * np.exp(strain),
        noise=Noise(0.04, 0.0),
    )  # fmt: skip


def test_a_bent_strip_is_pulled_straight():
    """The face that was measured has a n / (n + n_c) more, n the nominal stress; at most a."""
    seen, record = strip(lambda nominal: 0.01 * nominal / (nominal + 5.0))
    found, _ = predicted(bar(), record, "strain_offset", "straightening", (0.01, 5.0))
    own = found * np.exp(-(record.true_strain - seen)) / 1000.0
    np.testing.assert_allclose(own, seen, atol=2e-4)


def test_joints_seat_themselves_for_good_as_the_force_grows():
    """a (1 - e^(-n / n_c)) gauge lengths are travelled besides the bar's, n the largest nominal stress so far."""
    seen = np.concatenate([np.linspace(0.0, 0.3, 2000), np.linspace(0.3, 0.2, 500)])
    nominal = 1000.0 * seen * np.exp(-seen)
    stretch = np.exp(seen) - 0.01 * np.expm1(-np.maximum.accumulate(nominal) / 5.0)
    record = Record(
        id="joints", time=np.arange(2500.0), true_strain=np.log(stretch), true_stress=nominal * stretch,
        noise=Noise(0.04, 0.0),
    )  # fmt: skip
    found, _ = predicted(bar(), record, "strain_offset", "seating", (0.01, 5.0))
    np.testing.assert_allclose(found, record.true_stress, rtol=1e-3, atol=0.3)


def test_a_specimen_creeps_out_of_its_grips_ever_slower():
    """The bar has lost a (1 - e^(-(t / c)^0.7)) since the instant; the stress was made with the recorded strain."""
    record = ramp(end=1.0)
    model = CampaignModel(
        bar(),
        views_of(probation.Campaign(name="creep", records=(record,))),
        [cause("grip_slip", "creeping", record.id)],
    )
    found = model.predict(model.parameters(np.array([1000.0]), (0.01, 0.4, 0.05, 0.7)))[record.id]
    since = np.maximum(record.time / record.time[-1] - 0.4, 0.0) / 0.05
    lost = 0.01 * (1.0 - np.exp(-(since**0.7)))
    np.testing.assert_allclose(found, np.exp(lost) * 1000.0 * (record.true_strain - lost), rtol=1e-9, atol=1e-9)


def of_one(record, form, values):
    """The stress of the elastic bar whose specimen slips in one record."""
    views = views_of(probation.Campaign(name="slip", records=(record,)))
    model = CampaignModel(bar(), views, [cause("grip_slip", form, record.id)])
    return model.predict(model.parameters(np.array([1000.0]), values))[record.id]


def test_a_specimen_creeps_out_of_its_grips_by_the_pull():
    """Under a pull that grows as the time its rate is t^3, so that it has lost a (t / T)^4."""
    plain = ramp(end=0.5)
    record = replace(plain, true_stress=40.0 * plain.time / plain.time[-1] * np.exp(plain.true_strain))
    lost = 0.01 * (record.time / record.time[-1]) ** 4
    expected = np.exp(lost) * 1000.0 * (record.true_strain - lost)
    np.testing.assert_allclose(of_one(record, "creeping_with_pull", (0.01, 3.0)), expected, rtol=1e-5, atol=1e-3)


def test_a_specimen_slips_again_with_every_fall_of_the_force():
    """The bar loses a per MPa that the nominal stress falls by, 2 and 3 MPa, and the section was measured apart."""
    plain = ramp(end=0.5)
    fallen = 2.0 * (plain.time > 30.1) + 3.0 * (plain.time > 60.1)
    nominal = 20.0 * plain.time / plain.time[-1] - fallen
    record = replace(plain, true_stress=nominal * np.exp(plain.true_strain))
    expected = 1000.0 * (record.true_strain - 1e-3 * fallen)
    found = of_one(record, "several_measured_section", (1e-3,))
    np.testing.assert_allclose(found, expected, rtol=1e-6, atol=0.2)  # a fall is that beyond the rise around it


def test_a_part_of_the_jumps_of_the_strain_is_the_extensometers():
    plain = ramp(end=0.5)
    jumps = 0.004 * (plain.time > 30.1) - 0.006 * (plain.time > 60.1)
    record = replace(plain, true_strain=plain.true_strain + jumps)
    expected = 1000.0 * (record.true_strain - 0.75 * jumps)
    np.testing.assert_allclose(of_one(record, "knives_measured_section", (0.75,)), expected, rtol=1e-9, atol=1e-9)


def test_jaws_give_way_beyond_what_friction_holds():
    """Nothing up to a nominal stress of 50 MPa, then a per MPa."""
    _, record = strip(lambda nominal: 1e-4 * np.maximum(nominal - 50.0, 0.0))
    found, _ = predicted(bar(), record, "grip_slip", "progressive", (1e-4, 50.0))
    np.testing.assert_allclose(found, record.true_stress, rtol=2e-3, atol=0.01)


@pytest.mark.parametrize("dip", [0.0, -1e-6])
def test_the_rate_jumps_where_slack_ends_whatever_the_first_readings_are(dip):
    """Before the pull the strain was once read below the first reading."""
    strain = np.append([0.0, dip, 0.0], np.linspace(0.0, 0.4, 81)[1:])
    record = replace(ramp(samples=83), time=np.arange(83.0), true_strain=np.log1p(strain), sha256="")
    [view] = views_of(probation.Campaign(name="slack", records=(record,)))
    driven = view.driven(cause("strain_offset", form="slack").form.driving_strain(view, (0.0325,)))
    assert {8, 9} <= set(driven.jumps)


@pytest.mark.parametrize("slack", [0.002, 0.031])
def test_behind_slack_a_specimen_starts_as_it_would_without(slack):
    """The law has a companion relation, and slack ends within a step: its rate jumps there."""
    law = probation.Law(unrelaxed_modulus=3220.0, alpha=1.05, hardening_modulus=1.8, companion=WEISSENBERG_AS_PRINTED)
    elongation = np.linspace(0.0, 1.0, 301)
    record = replace(ramp(samples=301), time=elongation / RATE, true_strain=np.log1p(elongation), sha256="")
    found, _ = predicted(law, record, "strain_offset", "slack", (slack,), scheme="sa3")
    own = np.append(slack, elongation[elongation > slack])
    seen = np.log1p(own - slack)
    expected = (law.stress((own - slack) / RATE, seen, scheme="sa3") * np.exp(np.log1p(own) - seen))[1:]
    off = np.abs(found[elongation > slack] - expected)
    assert off[0] < 0.5
    assert np.max(off[5:]) < 0.06


def test_slack_is_taken_up_before_the_specimen_is_strained():
    """The elongation less a once taut, nothing before; the stress was made with the recorded strain."""
    found, _, strain = faulty("strain_offset", "slack", (0.02,))
    seen = np.log(np.maximum(np.exp(strain) - 0.02, 1.0))
    np.testing.assert_allclose(found, 1000.0 * seen * np.exp(strain - seen), rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("first", [-2e-5, 0.0, 2e-5])
@pytest.mark.parametrize("size", [1e-6, 1e-3])
def test_slack_begins_with_the_first_reading_whatever_its_noise(first, size):
    """The specimen stays there until it is taut: all that is strained further misses a, however small a is."""
    record = ramp(end=0.1)
    strain = record.true_strain.copy()
    strain[0] = first
    record = replace(record, true_strain=strain, sha256="")
    [view] = views_of(probation.Campaign(name="slack", records=(record,)))
    found = cause("strain_offset", form="slack").form.driving_strain(view, (size,))
    taut = np.log1p(np.expm1(strain) - size)
    np.testing.assert_allclose(found, np.where(taut > first, taut, first), rtol=0.0, atol=1e-15)


def test_a_toe_is_taken_up_gradually_and_never_backwards():
    """The specimen sees the elongation u - a tanh(u / u_t), u_t no less than a: its strain never falls."""
    for asked, reach in ((0.1, 0.1), (0.001, 0.02)):
        found, _, strain = faulty("strain_offset", "toe", (0.02, asked))
        elongation = np.exp(strain) - 1.0
        seen = np.log(1.0 + elongation - 0.02 * np.tanh(elongation / reach))
        np.testing.assert_allclose(found, 1000.0 * seen * np.exp(strain - seen), rtol=1e-10, atol=1e-10)


def test_a_wrong_zero_of_the_strain_only_bends_the_hardening():
    """The law starts relaxed at -a: E_u knows only differences, e_HT does not."""
    law = probation.Law(unrelaxed_modulus=3000.0, tau_max=6.0, hardening_modulus=0.0)
    record = ramp(end=1.0)
    found, _ = predicted(law, record, "strain_offset", "shift", (0.02,))
    np.testing.assert_allclose(
        found, math.exp(0.02) * law.stress(record.time, record.true_strain), rtol=1e-9, atol=1e-9
    )
    found, _ = predicted(QUICK, record, "strain_offset", "shift", (0.02,))
    expected = 2.0 * math.exp(0.02) * (math.exp(2 * 0.98) - math.exp(-0.98))
    assert found[-1] == pytest.approx(expected, rel=1e-3)


def test_a_compliant_machine_around_an_elastic_bar():
    """Made from the bar: stretch recorded = stretch + C F/A_0, true stress recorded = F/A_0 times that."""
    compliance, modulus = 2e-4, 1000.0
    seen = np.linspace(0.0, 0.3, 300)
    nominal = modulus * seen * np.exp(-seen)
    stretch = np.exp(seen) + compliance * nominal
    record = Record(
        id="frame", time=np.arange(300.0), true_strain=np.log(stretch), true_stress=nominal * stretch,
        noise=Noise(0.04, 0.0),
    )  # fmt: skip
    found, _ = predicted(bar(modulus), record, "machine_compliance", "crosshead", (compliance,))
    np.testing.assert_allclose(found, record.true_stress, rtol=1e-10, atol=1e-10)
    assert np.max(np.abs(modulus * record.true_strain - record.true_stress)) > 5.0


@pytest.mark.parametrize("power", [2.0 / 3.0, 1.0, 1.5])
def test_a_machine_whose_joints_close_or_whose_grips_yield(power):
    """Stretch recorded = stretch + C n (n / 10 MPa)^(b - 1), n the nominal stress: Hertz's contacts have 2/3."""
    seen = np.linspace(0.0, 0.1, 2000)
    nominal = 1000.0 * seen * np.exp(-seen)
    stretch = np.exp(seen) + 2e-4 * nominal * np.maximum(nominal / 10.0, 1e-12) ** (power - 1.0)
    record = Record(
        id="frame", time=np.arange(2000.0), true_strain=np.log(stretch), true_stress=nominal * stretch,
        noise=Noise(0.04, 0.0),
    )  # fmt: skip
    found, _ = predicted(bar(), record, "machine_compliance", "contact", (2e-4, power))
    np.testing.assert_allclose(found[20:], record.true_stress[20:], rtol=2e-3)


def test_compliance_taken_off_the_true_strain():
    """Recorded e = s/E + C s e^(-e): the bar's own stress, measured apart, follows from the recorded strain."""
    compliance, modulus = 2e-4, 1000.0
    strain = np.linspace(0.0, 0.3, 300)
    stress = strain / (1.0 / modulus + compliance * np.exp(-strain))
    record = Record(id="frame", time=np.arange(300.0), true_strain=strain, true_stress=stress, noise=Noise(0.04, 0.0))
    found, _ = predicted(bar(modulus), record, "machine_compliance", "true_strain", (compliance,))
    np.testing.assert_allclose(found, stress, rtol=1e-10, atol=1e-10)


def test_with_its_own_rates_a_record_is_corrected_as_without():
    """A slip (a step in strain) moves strain and given rates alike: be2 sees the same history either way."""
    record = ramp(end=1.0)
    rated = Record(
        id="ramp", time=record.time, true_strain=record.true_strain, true_stress=record.true_stress,
        strain_rate=np.full(len(record), RATE), noise=Noise(0.04, 0.0),
    )  # fmt: skip
    results = []
    for each in (record, rated):
        campaign = probation.Campaign(name="slip", records=(each,))
        for values in ((0.01, 0.5, 0.0), (0.0, 0.5, 0.0)):
            model = CampaignModel(DnlrLaw(LAW), views_of(campaign), [cause("grip_slip", None, each.id)])
            results.append(model.predict(model.parameters(LAW.parameters, values))[each.id])
    slipped, still, slipped_rated, still_rated = results
    assert np.min(slipped - still) < -10.0
    np.testing.assert_allclose(slipped_rated - still_rated, slipped - still, atol=2e-3)


@pytest.mark.parametrize(("form", "factor"), [("recorded_section", math.exp(0.01)), ("measured_section", 1.0)])
def test_a_slip_is_a_step_of_the_bars_strain(form, factor):
    record = ramp(end=1.0)
    model = CampaignModel(
        bar(),
        views_of(probation.Campaign(name="slip", records=(record,))),
        [cause("grip_slip", form, record.id)],
    )
    found = model.predict(model.parameters(np.array([1000.0]), (0.01, 0.6, 0.0)))[record.id]
    later = record.time > 0.6 * record.time[-1] + 1.0
    earlier = record.time < 0.6 * record.time[-1] - 1.0
    np.testing.assert_allclose(found[later], factor * 1000.0 * (record.true_strain[later] - 0.01), rtol=1e-10)
    np.testing.assert_allclose(found[earlier], 1000.0 * record.true_strain[earlier], rtol=1e-10)


def test_a_growing_volume_overstates_the_true_stress():
    found, _, strain = faulty("volume_change", "steady", (0.2,))
    np.testing.assert_allclose(found, 1000.0 * strain * np.exp(0.2 * strain), rtol=1e-12)
    found, _, strain = faulty("volume_change", "from_onset", (0.2, 0.3))
    np.testing.assert_allclose(found, 1000.0 * strain * np.exp(0.2 * np.maximum(strain - 0.3, 0.0)), rtol=1e-12)
    found, _, strain = faulty("volume_change", "levelling_off", (0.2, 0.3, 0.1))
    opened = 0.2 * (1.0 - np.exp(-np.maximum(strain - 0.3, 0.0) / 0.1))
    np.testing.assert_allclose(found, 1000.0 * strain * np.exp(opened), rtol=1e-12)


def test_a_measured_poisson_ratio_says_by_how_much_the_true_stress_is_overstated():
    """nu = 0.4: the volume strain is (1 - 2 nu) e = 0.2 e; half of it overlooked is a factor of e^(0.1 e)."""
    record = replace(ramp(), transverse_strain=-0.4 * ramp().true_strain)
    for substeps in (1, 4):
        found, _ = predicted(bar(), record, "volume_change", "as_measured", (0.5,), substeps=substeps)
        strain = record.true_strain
        np.testing.assert_allclose(found, 1000.0 * strain * np.exp(0.1 * strain), rtol=1e-12)
    constant = replace(record, transverse_strain=-0.5 * record.true_strain)
    found, _ = predicted(bar(), constant, "volume_change", "as_measured", (1.0,))
    np.testing.assert_allclose(found, 1000.0 * record.true_strain, rtol=1e-12)


@pytest.mark.parametrize(("form", "values", "cut"), [("fresh", (2.0,), 0.0), ("held", (2.0, 0.1), 0.1)])
def test_a_prestress_relaxes_with_the_modes_that_carry_it(form, values, cut):
    """a sum u_j e^(-t / tau_j), u_j ~ p_j e^(-cut tau_max / tau_j), on top of the ramp: the law is linear."""
    record = ramp(end=0.3, samples=2001)
    found, _ = predicted(LAW, record, "prestress", form, values, scheme="sa2")
    ratio = 10.0 ** (-(50.0 - np.arange(1, 51)) * 6.0 / 49.0)
    carried = np.sqrt(ratio) * np.exp(-cut / ratio)
    expected = 2.0 * np.exp(-np.outer(record.time, 1.0 / (6.0 * ratio))) @ (carried / carried.sum())
    np.testing.assert_allclose(found - LAW.stress(record.time, record.true_strain, scheme="sa2"), expected, atol=1e-9)


@pytest.mark.parametrize(
    ("form", "converted"), [("zeroed_under_load", True), ("zeroed_under_load_measured_section", False)]
)
def test_a_strain_that_was_zeroed_under_load_lacks_what_came_before(form, converted):
    """A ramp that is recorded from 0.006 on begins with p_j E_u r tau_j (1 - e^(-t / tau_j)) in its modes."""
    whole, first = ramp(end=0.306, samples=2041), 40
    stress = LAW.stress(whole.time, whole.true_strain, scheme="sa2")
    time, strain = whole.time[first:] - whole.time[first], whole.true_strain[first:] - whole.true_strain[first]
    record = probation.Record(id="from 0.006 on", time=time, true_strain=strain, true_stress=stress[first:])
    before = whole.true_strain[first]
    network = 2.0 * (np.exp(2.0 * before) - np.exp(-before))
    carried = stress[first] - network
    assert carried == pytest.approx(10.65, rel=0.01)  # 3000 MPa, 6 s, 1.2 s at 0.005 1/s
    values = (carried, whole.time[first] / 6.0, carried / before)
    found, _ = predicted(LAW, record, "prestress", form, values, scheme="sa2")
    np.testing.assert_allclose(found, np.exp(-before * converted) * stress[first:], rtol=2e-4)


def test_waves_on_force_stress_and_strain_over_time_and_over_the_elongation():
    wave = np.sin(2.0 * np.pi * 0.05 * np.linspace(0.0, 200.0, 400) + 0.7)
    found, _, strain = faulty("periodic_disturbance", "force", (0.3, 0.05, 0.7))
    np.testing.assert_allclose(found - 1000.0 * strain, 0.3 * wave * np.exp(strain), atol=1e-10)
    found, _, strain = faulty("periodic_disturbance", "stress", (0.3, 0.05, 0.7))
    np.testing.assert_allclose(found - 1000.0 * strain, 0.3 * wave, atol=1e-10)
    found, _, strain = faulty("periodic_disturbance", "strain", (1e-4, 0.05, 0.7))
    np.testing.assert_allclose(found - 1000.0 * strain, 0.1 * (wave - wave[0]), atol=1e-10)
    found, _, strain = faulty("periodic_disturbance", "screw_force", (0.3, 0.02, 0.7, 0.5, 0.2))
    turned = 2.0 * np.pi * np.expm1(strain) / 0.02
    wave = np.sin(turned + 0.7) + 0.5 * np.sin(2.0 * turned + 0.2)
    np.testing.assert_allclose(found - 1000.0 * strain, 0.3 * wave * np.exp(strain), atol=1e-10)
    found, _, strain = faulty("periodic_disturbance", "screw_strain", (1e-4, 0.02, 0.7, 0.5, 0.2))
    stretch = np.exp(strain) + 1e-4 * (wave - wave[0])
    np.testing.assert_allclose(found, 1000.0 * np.log(stretch) * np.exp(strain) / stretch, rtol=1e-9)


@pytest.mark.parametrize("first", [0.02, 0.055, 0.08])
@pytest.mark.parametrize("power", [0.0, 1.0], ids=["true stress", "force"])
def test_drops_recur_at_one_pitch_from_where_the_record_has_its_first(first, power):
    """2 MPa down at first + 0.1 k, then back along a straight line; away from the drops, which take 4 % of a pitch.

    A wait at 1.5, in which the force relaxes, does not hide the first drop; on the way back to 1.3 nothing more falls.
    """
    wait = np.arange(1.0, 401.0)
    strain = np.concatenate([np.linspace(0.0, 1.5, 1501), 1.5 + 1e-8 * wait, np.linspace(1.5, 1.3, 201)[1:]])
    relaxed = np.concatenate([np.ones(1501), 0.7 + 0.3 * np.exp(-wait / 50.0), np.full(200, 0.7)])
    pitch = (np.maximum.accumulate(strain) - first) / 0.1
    saw = 2.0 * np.exp(power * np.maximum.accumulate(strain)) * (pitch - np.floor(pitch) - 1.0)
    record = Record(
        id="teeth",
        time=np.arange(len(strain), dtype=np.float64),
        true_strain=strain,
        true_stress=(1000.0 * strain + saw) * relaxed,
        noise=Noise(0.04, 0.0),
    )
    found, _ = predicted(bar(), record, "serrated_flow", "recurring_drops", (2.0, 0.1, 10.0, 0.0, 0.006, power))
    # Grown after 3 % of strain; between two drops along a straight line within 3 % of a drop.
    seen = (np.abs(pitch - np.round(pitch)) > 0.06) & (strain > 0.03)
    np.testing.assert_allclose(found[seen] - 1000.0 * strain[seen], saw[seen], atol=0.04 * np.max(np.abs(saw)))
    # Of type A they rise above the law, by as much, and fall back to it.
    rising, _ = predicted(bar(), record, "serrated_flow", "recurring_rises", (2.0, 0.1, 10.0, 0.0, 0.006, power))
    size = 2.0 * np.exp(power * np.maximum.accumulate(strain[seen]))
    np.testing.assert_allclose(rising[seen] - found[seen], size, rtol=0.01)


def test_a_warmer_day_is_another_law():
    """3 degrees: tau_max e^(-0.3), G e^(-0.015); from test to test the last record has it all, the first nothing."""
    first, last = ramp(1e-3), ramp(2e-2)
    warm_law = LAW.with_parameters([3000.0, 6.0 * math.exp(-0.3), 2.0 * math.exp(-0.015)])
    campaign = probation.Campaign(name="days", records=(first, last))
    model = CampaignModel(DnlrLaw(LAW), views_of(campaign), [cause("temperature_drift", "test_to_test")])
    found = model.predict(model.parameters(LAW.parameters, (3.0, 0.1, 0.05)))
    np.testing.assert_allclose(found[first.id], LAW.stress(first.time, first.true_strain), rtol=1e-12)
    np.testing.assert_allclose(found[last.id], warm_law.stress(last.time, last.true_strain), rtol=1e-12)


def test_warming_within_a_record_is_integrated_independently():
    """One mode by scipy with the temperature rising to 5 degrees at the end."""
    law = probation.Law(unrelaxed_modulus=900.0, tau_max=4.0, hardening_modulus=2.0, spectrum=ONE_MODE)
    record = ramp(end=1.0, samples=600)

    def slope(t, stress):
        rise, strain = 5.0 * t / 200.0, RATE * t
        relaxed = 2.0 * math.exp(-0.005 * rise) * (math.exp(2.0 * strain) - math.exp(-strain))
        return 900.0 * RATE - (stress - relaxed) / (4.0 * math.exp(-0.1 * rise))

    expected = solve_ivp(slope, (0.0, 200.0), [0.0], "LSODA", record.time, rtol=1e-10, atol=1e-10).y[0]
    found, _ = predicted(law, record, "temperature_drift", "within_record", (5.0, 0.1, 0.05), scheme="sa3", substeps=4)
    np.testing.assert_allclose(found, expected, atol=2e-4)


def test_a_saturated_load_cell_stands_still():
    """At a nominal stress of 250 MPa: 1000 e e^(-e) exceeds it from a strain of 0.3574 on (and its peak is 368)."""
    found, _, strain = faulty("force_saturation", "clip", (1.0 / 250.0,))
    free = strain < 0.357
    np.testing.assert_allclose(found[free], 1000.0 * strain[free], rtol=1e-12)
    np.testing.assert_allclose(found[~free], np.minimum(250.0 * np.exp(strain), 1000.0 * strain)[~free], rtol=1e-12)


def test_an_amplifier_bends_into_its_limit():
    """The hyperbola through 0 whose asymptotes are the force and 250 MPa: at the limit half its rounding is missing;
    well below and well above it is the clip."""
    limit, rounding = 250.0, 0.02
    found, _, strain = faulty("force_saturation", "bend", (1.0 / limit, rounding))
    force, read = 1000.0 * strain * np.exp(-strain), found * np.exp(-strain)
    far = np.abs(force - limit) > 0.3 * limit
    np.testing.assert_allclose(read[far], np.minimum(force, limit)[far], rtol=1e-3, atol=0.1)
    at_limit = int(np.argmin(np.abs(force[: len(force) // 2] - limit)))
    assert limit - read[at_limit] == pytest.approx(0.5 * rounding * limit, rel=0.2)
    assert found[0] == 0.0


def cycles(samples=1501):
    """A force up to 100 MPa, down to 20 and up again, as a record of an elastic bar."""
    strain = np.interp(np.linspace(0.0, 1.0, samples), [0.0, 0.5, 0.8, 1.0], [0.0, 0.1, 0.02, 0.1])
    record = Record(
        id="cycles", time=np.arange(float(samples)), true_strain=strain, true_stress=1000.0 * strain,
        noise=Noise(0.04, 0.0),
    )  # fmt: skip
    return record, 1000.0 * strain * np.exp(-strain)


def test_a_guide_rubs_against_the_motion():
    """0.4 MPa over the initial section: more on the way out, less on the way back, neither where it turns."""
    record, force = cycles()
    found, _ = predicted(bar(), record, "guide_friction", "sliding", (0.4,))
    way = np.sign(np.diff(record.true_strain, prepend=0.0))
    way[[0, 750, 1200]] = 0.0
    np.testing.assert_allclose(found * np.exp(-record.true_strain), force + 0.4 * way, atol=1e-9)


def test_friction_of_a_guide_stays_in_a_dwell_and_is_none_before_the_first_motion():
    """At rest, out, a dwell, back: the strain of the dwells trembles by less than its noise."""
    time = np.arange(401.0)
    strain = np.interp(time, [0.0, 60.0, 160.0, 300.0, 400.0], [0.0, 0.0, 0.1, 0.1, 0.02])
    strain += 1e-6 * np.random.default_rng(1).standard_normal(401)
    record = Record(id="dwells", time=time, true_strain=strain, true_stress=1e3 * strain, noise=Noise(0.04, 1e-6))
    [view] = views_of(probation.Campaign(name="dwells", records=(record,)))
    way = cause("guide_friction", form="sliding").form.recorded_stress(view, (1.0,), np.zeros(401)) / np.exp(strain)
    assert np.all(way[:55] == 0.0)
    np.testing.assert_allclose(way[65:296], 1.0, rtol=1e-4)
    np.testing.assert_allclose(way[305:], -1.0, rtol=1e-4)


def test_in_a_record_that_nothing_moves_a_guide_does_not_rub():
    held, loops = replace(ramp(), true_strain=np.full(400, 0.02), sha256=""), cycles()[0]
    found, _ = predicted(bar(), held, "guide_friction", "sliding", (0.4,), others=(loops,))
    np.testing.assert_allclose(found, 20.0, rtol=1e-12)


def test_a_rod_that_the_force_moves_turns_with_it():
    """0.4 MPa once the force has changed by 2 MPa, as much against it 4 MPa after it has turned."""
    record, force = cycles()
    found, _ = predicted(bar(), record, "guide_friction", "with_the_force", (0.4, 2.0))
    rubs, top = found * np.exp(-record.true_strain) - force, float(np.max(force))
    np.testing.assert_allclose(rubs[:751], 0.2 * np.minimum(force[:751], 2.0), atol=1e-9)
    np.testing.assert_allclose(rubs[751:1201], 0.2 * np.maximum(2.0 - (top - force[751:1201]), -2.0), atol=1e-9)


def test_friction_of_a_guide_builds_up_along_the_way_as_its_differential_equation_says():
    """dz/dl = 1/w - z |dl|/(w dl), by the trapezoidal rule."""
    record, force = cycles(6001)
    found, _ = predicted(bar(), record, "guide_friction", "building_up", (0.4, 0.01))
    slid = [0.0]
    for step in np.diff(np.exp(record.true_strain)) / 0.01:
        slid.append((slid[-1] * (1.0 - 0.5 * abs(step)) + step) / (1.0 + 0.5 * abs(step)))
    np.testing.assert_allclose(found * np.exp(-record.true_strain), force + 0.4 * np.array(slid), atol=1e-4)


def test_friction_that_builds_up_is_that_of_its_differential_equation():
    """dz/dF = 1/r - z |dF|/(r dF), in time by the trapezoidal rule; the reading is F - a M z / 2."""
    record, force = cycles()
    found, _ = predicted(bar(), record, "cell_hysteresis", "presliding", (0.03, 0.2))
    largest, slid = float(np.max(force)), [0.0]
    for step in np.diff(force) / (0.2 * largest):
        slid.append((slid[-1] * (1.0 - 0.5 * abs(step)) + step) / (1.0 + 0.5 * abs(step)))
    expected = force - 0.5 * 0.03 * largest * np.array(slid)
    np.testing.assert_allclose(found * np.exp(-record.true_strain), expected, atol=1e-4)


def test_contacts_that_stick_and_slide_open_a_loop_of_the_given_width():
    """Once all slide, the ways up and down differ by a of the largest force; before any does, the force reads less."""
    record, force = cycles()
    found, _ = predicted(bar(), record, "cell_hysteresis", "stops", (0.03, 0.2))
    reading, largest = found * np.exp(-record.true_strain), float(np.max(force))
    up, down = slice(0, 751), slice(751, 1201)
    level = 0.5 * largest
    read_up = np.interp(level, force[up], reading[up])
    read_down = np.interp(-level, -force[down], reading[down])
    assert read_down - read_up == pytest.approx(0.03 * largest, rel=1e-3)
    assert np.interp(0.4, force[up], reading[up]) == pytest.approx(0.4 * (1.0 - 0.5 * 0.03 / 0.1), rel=1e-6)


def test_flow_after_a_reversal_is_the_law_in_a_time_that_runs_faster():
    """Up at 0.01 1/s, down from 0.6 to 0.5 and up again: dt / e^(-a e^(-p/r)) is (r / rate) dE_1 in closed form."""
    loss, reach, rate = 0.5, 0.05, 0.01
    corners = np.array([0.0, 60.0, 70.0, 100.0])
    time = np.linspace(0.0, 100.0, 4001)
    strain = np.interp(time, corners, [0.0, 0.6, 0.5, 0.8])
    record = replace(ramp(samples=4001), time=time, true_strain=strain)
    found, _ = predicted(LAW, record, "back_stress", "after_reversal", (loss, reach))

    def since(path):
        return reach / rate * (expi(loss) - expi(loss * np.exp(-path / reach)))

    own = time.copy()
    own[time > 60.0] = 60.0 + since(rate * (time[time > 60.0] - 60.0))
    own[time > 70.0] = 60.0 + since(0.1) + since(rate * (time[time > 70.0] - 70.0))
    expected, without = (LAW.stress(instants, strain, scheme="sa3") for instants in (own, time))
    # The factor jumps at a corner, and is a straight line within a step.
    assert np.linalg.norm(found - expected) < 0.02 * np.linalg.norm(found - without)


def test_surfaces_of_back_stress_follow_the_plastic_strain_exponential_by_exponential():
    """Up, down and up again: the plastic strain is the strain less or plus its elastic part, held between."""
    size, reach, elastic, spread = 1.2, 0.05, 0.02, 0.4
    strain = np.interp(np.arange(361), [0, 120, 200, 360], [0.0, 0.6, 0.4, 0.7])
    record = replace(ramp(samples=361), time=np.arange(361.0), true_strain=strain)
    found, _ = predicted(QUICK, record, "back_stress", "several_surfaces", (size, reach, elastic, spread))
    still, _ = predicted(QUICK, record, "back_stress", "several_surfaces", (0.0, reach, elastic, spread))
    plastic = np.concatenate(
        [
            np.maximum(0.0, strain[:121] - elastic),
            np.minimum(0.6 - elastic, strain[121:201] + elastic),
            np.maximum(0.4 + elastic, strain[201:] - elastic),
        ]
    )
    expected = np.zeros(361)
    for factor in (10.0**-spread, 1.0, 10.0**spread):
        first = -np.expm1(-plastic / (reach * factor))
        second = -1.0 + (first[120] + 1.0) * np.exp((plastic - plastic[120]) / (reach * factor))
        third = 1.0 + (second[200] - 1.0) * np.exp(-(plastic - plastic[200]) / (reach * factor))
        expected += np.concatenate([first[:121], second[121:201], third[201:]]) * size / 3.0
    assert found - still == pytest.approx(expected, abs=0.02 * size)
