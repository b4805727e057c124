"""Inputs at the edge of what makes sense: finite answers, and the right ones where they are known."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import Modification
from reference import literal, paper

SCHEMES = ("be2", "sa2", "sa3", "exact")
TIME = np.linspace(0.0, 40.0, 201)
STRAIN = 0.005 * TIME


def law(**changed):
    return probation.Law(**({"unrelaxed_modulus": 3220.0, "tau_max": 5.2, "hardening_modulus": 2.5} | changed))


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("modes", [*range(1, 10), 27, 28, 29, 50, 57, 200])
def test_any_number_of_modes(scheme, modes):
    """Every way in which the modes fill vectors and blocks; the closed form knows nothing of either."""
    base = law(modes=modes)
    found = base.stress(TIME, STRAIN, scheme)
    atol = {"be2": 0.06, "sa2": 0.002, "sa3": 1e-5, "exact": 1e-11}[scheme]
    assert_allclose(found, probation.ramp_stress(base, 0.005, TIME), rtol=0.0, atol=atol)


@pytest.mark.parametrize("scheme", SCHEMES)
def test_tiny_decades_are_one_mode(scheme):
    found = law(decades=1e-12).stress(TIME, STRAIN, scheme)
    assert_allclose(found, law(modes=1).stress(TIME, STRAIN, scheme), rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("scheme", [*SCHEMES, "cvode"])
def test_a_huge_time_is_elastic(scheme):
    """At tau_max = 1e30 s and few decades nothing relaxes: sigma = E_u e."""
    found = law(tau_max=1e30, decades=2.0).stress(TIME, STRAIN, scheme)
    assert_allclose(found, 3220.0 * STRAIN, rtol=1e-10, atol=1e-10)


@pytest.mark.parametrize("scheme", SCHEMES)
@pytest.mark.parametrize("tau", [1e-12, 1e-100, 1e-290])
def test_a_tiny_time_is_relaxed(scheme, tau):
    found = law(tau_max=tau).stress(TIME, STRAIN, scheme)
    assert_allclose(found, 2.5 * literal.hardening_strain(STRAIN), rtol=1e-9, atol=1e-9)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3"])
@pytest.mark.parametrize("tau", [1e-100, 1e-12, 1e30])
def test_sensitivities_stay_finite_with_them(scheme, tau):
    _, found = law(tau_max=tau).sensitivity(TIME, STRAIN, scheme)
    assert np.isfinite(found).all()
    assert_allclose(found[:, 0] * 3220.0 + found[:, 2] * 2.5, law(tau_max=tau).stress(TIME, STRAIN, scheme), atol=1e-9)


def test_a_hundred_thousand_samples():
    """Ramp and a long hold; the decaying modes pass through subnormal numbers on their way to zero."""
    time = np.linspace(0.0, 1e6, 100_001)
    strain = np.minimum(0.001 * time, 1.0)
    for scheme in ("be2", "sa2", "sa3"):
        found = law().stress(time, strain, scheme)
        assert_allclose(found[-1], 2.5 * literal.hardening_strain(1.0), rtol=1e-12)


@pytest.mark.parametrize("scheme", ["be2", "sa2", "sa3"])
def test_steps_that_grow_tenfold_are_survived(scheme):
    """BDF2 is unstable above 2.41 and starts afresh; the exact solution is near."""
    time = np.concatenate([[0.0], np.cumsum(10.0 ** np.repeat([-3, -2, -1, 0], 20))])
    base = law()
    found, exact = (
        base.stress(probation.StrainHistory(time, 0.005 * time, jumps=None), scheme=s) for s in (scheme, "exact")
    )
    assert np.abs(found - exact).max() < 0.5


@pytest.mark.parametrize("scheme", [*SCHEMES, "cvode"])
def test_compression_is_taken_like_tension(scheme):
    """The elastic part is odd in the strain; e_HT of compression is e^-2e - e^e."""
    base = law(hardening_modulus=0.0)
    assert_allclose(base.stress(TIME, -STRAIN, scheme), -base.stress(TIME, STRAIN, scheme), rtol=0.0, atol=1e-8)
    found = law().stress(TIME, -10.0 * STRAIN, scheme)
    atol = {"be2": 0.5, "sa2": 0.02, "sa3": 1e-3, "exact": 1e-10, "cvode": 1e-5}[scheme]
    assert_allclose(found, probation.ramp_stress(law(), -0.05, TIME), rtol=0.0, atol=atol)


@pytest.mark.parametrize("scheme", [*SCHEMES, "cvode"])
@pytest.mark.parametrize("form", ["weissenberg", "exponential", "power", "table", "function"])
def test_holds_with_a_companion_relation_are_finite(scheme, form):
    companion = {
        "weissenberg": probation.Weissenberg(0.00464, 0.0367),
        "exponential": probation.Exponential(27.24, -2.1),
        "power": probation.PowerLaw(0.03, -1.0),
        "table": probation.Table(tuple(paper.TABLE_2), tuple(paper.TABLE_2.values())),
        "function": probation.RateFunction(lambda rate: 0.03 / rate),
    }[form]
    time = np.linspace(0.0, 40.0, 41)
    strain = np.where(time < 10, 0.01 * time, np.where(time < 30, 0.1, 0.1 - 0.005 * (time - 30)))
    found = law(tau_max=None, companion=companion, modes=8).stress(time, strain, scheme)
    assert np.isfinite(found).all()
    assert (np.diff(found[11:30]) <= 1e-9).all()  # it relaxes


def test_sa3_falls_back_where_reduced_time_would_run_backwards():
    """tau grows a thousandfold within one step: h (5 f+ + 8 f - f-) / 12 is negative with f- = 1000 f.

    The trapezoid takes its place, and SA2 that of SA3.
    """
    time = np.arange(12) * 0.5
    factor = np.where(time < 2.4, 1e-3, 1.0)
    found = {
        s: law(modes=4).stress(
            probation.StrainHistory(time, 0.01 * time, jumps=None),
            scheme=s,
            modification=Modification(relaxation_time_factor=factor),
        )
        for s in ("sa2", "sa3", "exact")
    }
    assert np.abs(found["sa3"] - found["exact"]).max() < 0.5
    assert np.isfinite(found["sa3"]).all()


@pytest.mark.parametrize("direction", [1, -1])
def test_noise_against_the_command_sees_the_floor(direction):
    """Commanded up, measured down: the companion relation sees the floor's time, not that of the modulus."""
    companion = probation.PowerLaw(1.0, -1.0, rate_floor=1e-6)  # tau = 1 / rate
    base = law(tau_max=None, companion=companion, modes=1, hardening_modulus=0.0)
    time, strain = np.array([0.0, 1.0, 2.0]), direction * np.array([0.0, 0.1, 0.08])
    clipped = base.stress(probation.StrainHistory(time, strain, direction=[direction, direction]), scheme="exact")
    modulus = base.stress(probation.StrainHistory(time, strain, direction=[0, 0]), scheme="exact")
    first = 3220.0 * (1.0 - np.exp(-0.1))  # E_u rate tau (1 - e^(-t / tau)), rate tau = 1
    hold = first * np.exp(-1e-6) - 3220.0 * 0.02 * -np.expm1(-1e-6) / 1e-6
    seen = first * np.exp(-0.02) - 3220.0 * (1.0 - np.exp(-0.02))
    assert_allclose(direction * clipped, [0.0, first, hold], rtol=1e-12)
    assert_allclose(direction * modulus, [0.0, first, seen], rtol=1e-12)
