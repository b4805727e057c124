"""Does eq. (7) hold at every limit where its printed form does not?"""

import re

import numpy as np
import pytest

import probation
from reference import literal, paper

E_U, TAU, G = paper.E_U, paper.TAU_MAX, paper.G


def close(found, expected):
    assert found == pytest.approx(expected, rel=2e-14, abs=1e-300)


def one_mode(tau):
    return probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=tau, modes=1)


@pytest.mark.parametrize("rate", [5e-5, 0.005, 0.1, -0.005, -0.3])
@pytest.mark.parametrize("strain", [1e-9, 1e-3, 0.2, 2.0])
def test_it_is_eq_7_in_40_digits(rate, strain):
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    time = strain / abs(rate)
    found = probation.ramp_stress(law, rate, [time])[0]
    expected = literal.mp_ramp(rate, time, E_U, G, TAU)
    assert found == pytest.approx(expected, rel=1e-13)


@pytest.mark.parametrize("time", [1e-12, 0.3, 4.0, 40.0])
@pytest.mark.parametrize(
    ("rate", "tau"),
    [
        (0.5, 2.0),  # tau_j = 1 / rate: infinite as printed
        (-0.125, 4.0),  # rate = -1 / (2 tau_j): 0 / 0
        (-0.5, 2.0),
        (0.0, 3.0),  # 0 / 0
        (np.nextafter(0.5, 1.0), 2.0),  # beside the holes, where the printed form loses all digits
        (0.5 * (1.0 + 1e-9), 2.0),
        (-0.125 * (1.0 - 1e-12), 4.0),
        (1e-200, 3.0),
    ],
)
def test_one_mode_at_the_holes_of_the_printed_form(rate, tau, time):
    found = probation.ramp_stress(one_mode(tau), rate, [time])[0]
    close(found, literal.mp_ramp(rate, time, E_U, G, tau, modes=1, tau=[tau]))


def test_the_limit_at_tau_equal_to_one_over_rate_by_hand():
    """E_u = 0, rate = 1/tau = 1, t = 1: G [int_0^1 e^(2s) e^(s-1) ds - int_0^1 e^(-s) e^(s-1) ds]

    = G [(e^2 - e^-1) / 3 - e^-1].
    """
    law = probation.Law(unrelaxed_modulus=0.0, hardening_modulus=3.0, tau_max=1.0, modes=1)
    expected = (np.exp(2.0) - np.exp(-1.0)) - 3.0 * np.exp(-1.0)
    close(probation.ramp_stress(law, 1.0, [1.0])[0], expected)


def test_a_very_short_ramp_is_elastic():
    """sigma -> E_u rate t; at t = 1e-12 s the rest is below t / tau_1 = 2e-7 of it."""
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    assert probation.ramp_stress(law, 0.005, [1e-12])[0] == pytest.approx(E_U * 0.005e-12, rel=2e-7)
    assert probation.ramp_stress(law, 0.005, [0.0])[0] == 0.0


def test_a_very_slow_ramp_is_relaxed():
    """sigma -> G e_HT (and E_u rate sum p tau, which is 1e-9 of it here)."""
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    found = probation.ramp_stress(law, 1e-12, [1e12])[0]
    assert found == pytest.approx(G * literal.hardening_strain(1.0), rel=1e-8)


def test_with_a_companion_relation_it_uses_the_rates_own_time():
    """Eq. (11) at 0.005 1/s: 5.2046 s times alpha."""
    tau = 1.1 * (0.00464 * np.log10(0.005) + 0.0367) / 0.005
    companion = probation.Weissenberg(*paper.WEISSENBERG)
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, alpha=1.1, companion=companion)
    for rate in (0.005, -0.005):
        found = probation.ramp_stress(law, rate, [0.0, 7.0])[1]
        assert found == pytest.approx(literal.mp_ramp(rate, 7.0, E_U, G, tau), rel=1e-13)


@pytest.mark.parametrize("rate", [0.005, -0.02])
def test_exact_walks_along_it(rate):
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    time = paper.uneven(200, 1.0 / abs(rate))
    found = law.stress(time, rate * time, "exact")
    np.testing.assert_allclose(found, probation.ramp_stress(law, rate, time), rtol=1e-12, atol=1e-12)


@pytest.mark.parametrize(
    ("rate", "time", "message"),
    [
        (np.nan, [1.0], "strain_rate"),
        (np.inf, [1.0], "strain_rate"),
        ("fast", [1.0], "strain_rate"),
        (0.1, [-1e-9], r"time\[0\]"),
        (0.1, [0.0, np.nan], r"time\[1\]"),
        (0.1, [[1.0]], "time"),
    ],
)
def test_bad_input_is_named(rate, time, message):
    with pytest.raises(probation.InputError, match=message):
        probation.ramp_stress(one_mode(1.0), rate, time)


@pytest.mark.parametrize(
    ("rate", "time"),
    [
        (1e5, 1e-3),  # a strain of 100
        (1e3, 0.354),  # e^(2 strain) is 3e307
        (-1e5, 3e-3),
        (1e-300, 1e300),
        (1e300, 3e-300),
        (1e-3, 1e-310),
    ],
)
def test_fast_slow_and_short_ramps_have_their_finite_answer(rate, time):
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    found = probation.ramp_stress(law, rate, [time])[0]
    assert found == pytest.approx(literal.mp_ramp(rate, time, E_U, G, TAU), rel=1e-12)


def test_where_the_exponential_overflows_and_the_stress_does_not_there_is_an_answer():
    """e^(2 strain) is 1e313 at a strain of 360, G of 1e-10 MPa brings it back."""
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=1e-10, tau_max=TAU)
    found = probation.ramp_stress(law, 1e3, [0.36])[0]
    assert found == pytest.approx(literal.mp_ramp(1e3, 0.36, E_U, 1e-10, TAU), rel=1e-12)
    soft = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=0.0, tau_max=TAU)
    assert probation.ramp_stress(soft, 1e5, [1.0])[0] == pytest.approx(literal.mp_ramp(1e5, 1.0, E_U, 0.0, TAU))


@pytest.mark.parametrize(("rate", "strain"), [(1e5, "100000"), (-1e5, "-100000"), (1e308, "1e+308")])
def test_a_stress_beyond_all_numbers_is_refused_with_rate_and_time(rate, strain):
    law = probation.Law(unrelaxed_modulus=E_U, hardening_modulus=G, tau_max=TAU)
    named = rf"time\[1\] = 1 s .*strain_rate = {re.escape(f'{rate:g}')} 1/s .* strain {re.escape(strain)}"
    with pytest.raises(probation.InputError, match=named):
        probation.ramp_stress(law, rate, [0.0, 1.0])
