"""What must hold for every law and every history, tried on random ones."""

import numpy as np
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

import probation
from reference import paper

SCHEMES = ("be2", "sa2", "sa3", "exact")
few = settings(max_examples=25, deadline=None, suppress_health_check=[HealthCheck.too_slow], derandomize=True)

schemes = st.sampled_from(SCHEMES)
seeds = st.integers(0, 2**31)
moduli = st.floats(1.0, 5000.0)
hardenings = st.floats(0.0, 10.0)
times = st.floats(0.05, 500.0)


def law(E_u, G, tau, **changed):
    return probation.Law(**({"unrelaxed_modulus": E_u, "hardening_modulus": G, "tau_max": tau, "modes": 20} | changed))


def random_history(seed, n=60, duration=30.0, initial=0.0):
    """Smooth: a drift and three waves slower than twelve steps; uneven steps."""
    rng = np.random.default_rng(seed)
    time = paper.uneven(n, duration, seed)
    strain = initial + rng.uniform(-0.01, 0.02) * time
    for _ in range(3):
        frequency, phase = rng.uniform(0.05, 0.8), rng.uniform(0.0, 6.0)
        strain += rng.uniform(-0.02, 0.02) * (np.sin(frequency * time + phase) - np.sin(phase))
    return time, strain


@few
@given(schemes, seeds, moduli, hardenings, times, st.floats(0.01, 100.0))
def test_stress_is_linear_in_the_two_moduli(scheme, seed, E_u, G, tau, factor):
    """Sigma(a E_u, b G) = a sigma(E_u, 0) + b sigma(0, G)."""
    time, strain = random_history(seed, initial=0.1)
    whole = law(factor * E_u, G, tau).stress(time, strain, scheme)
    elastic = law(E_u, 0.0, tau).stress(time, strain, scheme)
    relaxed = law(0.0, G, tau).stress(time, strain, scheme)
    scale = np.abs(factor * elastic).max() + np.abs(relaxed).max() + 1e-300
    assert_allclose(whole, factor * elastic + relaxed, rtol=0.0, atol=1e-11 * scale)


@few
@given(schemes, seeds, times, st.sampled_from([2.0**-20, 0.125, 3.7, 1e6]))
def test_only_the_ratio_of_times_counts(scheme, seed, tau, factor):
    """Eq. (6) has no time of its own but tau_max."""
    time, strain = random_history(seed)
    plain = law(3000.0, 2.0, tau).stress(probation.StrainHistory(time, strain, jumps=None), scheme=scheme)
    scaled = law(3000.0, 2.0, tau * factor).stress(
        probation.StrainHistory(time * factor, strain, jumps=None), scheme=scheme
    )
    assert_allclose(scaled, plain, rtol=0.0, atol=1e-9)


@few
@given(schemes, seeds, st.floats(0.005, 0.2), st.floats(0.01, 100.0))
def test_at_a_constant_weissenberg_number_the_law_knows_no_rate(scheme, seed, number, factor):
    """With tau = We / rate the law per unit strain has no time in it."""
    time, strain = random_history(seed)
    strain = np.maximum.accumulate(strain) + 1e-3 * time  # no holds: the floor would be a time of its own
    base = law(3000.0, 2.0, None, companion=probation.PowerLaw(number, -1.0, rate_floor=1e-30))
    plain = base.stress(probation.StrainHistory(time, strain, jumps=None), scheme=scheme)
    scaled = base.stress(probation.StrainHistory(time * factor, strain, jumps=None), scheme=scheme)
    assert_allclose(scaled, plain, rtol=0.0, atol=1e-8)


@few
@given(seeds, times, st.integers(0, 58), st.floats(0.01, 0.99))
def test_splitting_a_straight_step_changes_nothing_for_exact(seed, tau, step, where):
    time, strain = random_history(seed)
    base = law(3000.0, 2.0, tau)
    between = time[step] + where * (time[step + 1] - time[step])
    more_time = np.insert(time, step + 1, between)
    more_strain = np.insert(strain, step + 1, np.interp(between, time, strain))
    split = base.stress(more_time, more_strain, "exact")
    assert_allclose(np.delete(split, step + 1), base.stress(time, strain, "exact"), rtol=0.0, atol=1e-9)


@few
@given(schemes, times, st.floats(-1.0, 1.5), st.integers(0, 1000))
def test_a_relaxed_start_stays_relaxed(scheme, tau, initial, seed):
    time = paper.uneven(40, 100.0, seed)
    found = law(3000.0, 2.0, tau).stress(time, np.full(41, initial), scheme)
    expected = 2.0 * (np.exp(2 * initial) - np.exp(-initial))
    assert_allclose(found, expected, rtol=1e-11, atol=1e-11)


@few
@given(seeds, st.floats(1.0, 100.0), st.booleans())
def test_all_schemes_tell_the_same_story(seed, tau, with_companion):
    """On 4000 steps of a smooth history they differ by their own small errors."""
    time, strain = random_history(seed, n=4000)
    base = law(1000.0, 2.0, tau)
    if with_companion:
        strain = strain + 0.05 * time  # rates of one sign
        base = law(1000.0, 2.0, None, companion=probation.Weissenberg(*paper.WEISSENBERG))
    stress = {
        scheme: base.stress(probation.StrainHistory(time, strain, jumps=None), scheme=scheme) for scheme in SCHEMES
    }
    for scheme in ("be2", "sa2", "exact"):
        assert np.abs(stress[scheme] - stress["sa3"])[200:].max() < 0.02


@few
@given(schemes, seeds, times)
def test_the_past_does_not_answer_to_the_future(scheme, seed, tau):
    time, strain = random_history(seed)
    other = strain.copy()
    other[31:] += 0.1
    base = law(3000.0, 2.0, tau)
    first, second = (
        base.stress(probation.StrainHistory(time, each, jumps=None), scheme=scheme) for each in (strain, other)
    )
    assert np.array_equal(first[:31], second[:31])
    assert (first[31:] != second[31:]).all()


@few
@given(schemes, seeds, times, st.floats(-1e4, 1e4))
def test_the_clock_may_start_anywhere(scheme, seed, tau, offset):
    time, strain = random_history(seed)
    base = law(3000.0, 2.0, tau)
    plain, shifted = (
        base.stress(probation.StrainHistory(t, strain, jumps=None), scheme=scheme) for t in (time, time + offset)
    )
    assert_allclose(shifted, plain, rtol=0.0, atol=1e-6)
