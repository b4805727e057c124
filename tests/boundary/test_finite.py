"""Every array that comes back is finite, or an error says why not: whatever the numbers that go in.

PROBATION_EXAMPLES=3000 in the environment tries so many examples of each kind instead of 60.
"""

import os

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

import probation
from probation import batch
from probation.law.history import StrainHistory

EXAMPLES = int(os.environ.get("PROBATION_EXAMPLES", "60"))
thorough = settings(max_examples=EXAMPLES, deadline=None, suppress_health_check=list(HealthCheck), derandomize=True)

EDGES = (0.0, 5e-324, 1e-310, 2.3e-308, 1e-300, 1e-150, 1e-9, 1.0, 1e9, 1e150, 1e300, 1.7e308)
finite = st.floats(allow_nan=False, allow_infinity=False)
positive = st.sampled_from(EDGES[1:]) | st.floats(1e-3, 1e3) | finite.map(abs).filter(bool)
not_negative = st.just(0.0) | positive
strains = st.sampled_from((0.0, 5e-324, 1e-200, 0.1, 1.0, 50.0, 354.0, -354.0, 708.0, 1e308)) | st.floats(-1.0, 1.0)
steps = st.sampled_from((5e-324, 1e-309, 1e-307, 1e-300, 1e-3, 1e6, 1e300, 1e308)) | st.floats(1e-3, 10.0)
sane = st.floats(0.5, 2.0)


@st.composite
def laws(draw):
    """With a companion relation or without; every second one has ordinary parameters."""
    number, rest = (sane, sane) if draw(st.booleans()) else (positive, not_negative)
    modes = {"modes": draw(st.integers(1, 6)), "decades": draw(st.sampled_from((1e-12, 2.0, 6.0, 299.0)))}
    moduli = {"unrelaxed_modulus": 1e3 * draw(rest), "hardening_modulus": draw(rest)}
    relation = draw(
        st.sampled_from(
            (
                None,
                probation.Weissenberg(0.00464, 0.0367),
                probation.Exponential(27.24, -2.1),
                probation.PowerLaw(0.05, -0.9),
                probation.PowerLaw(1e-3, 30.0),
                probation.Table((1e-4, 1e-2), (1e-30, 1e30)),
            )
        )
    )
    try:
        if relation is None:
            return probation.Law(**moduli, **modes, tau_max=draw(number))
        return probation.Law(**moduli, **modes, alpha=draw(number), companion=relation)
    except probation.InputError:  # beyond all numbers already
        return probation.Law(unrelaxed_modulus=1.0, hardening_modulus=1.0, tau_max=draw(sane), **modes)


@st.composite
def histories(draw):
    """Times and strains of some samples, ordinary ones or not."""
    count = draw(st.integers(2, 8))
    dt = draw(st.lists(steps if draw(st.booleans()) else sane, min_size=count - 1, max_size=count - 1))
    strain = draw(st.lists(strains if draw(st.booleans()) else st.floats(0.0, 1.0), min_size=count, max_size=count))
    with np.errstate(over="ignore"):
        time = np.minimum(np.cumsum([0.0, *dt]), 1.7e308)
    return time, np.array(strain)


def finite_or_refused(function):
    """Call it; whether there was an answer. What it returns is finite."""
    with np.errstate(all="raise", under="ignore"):
        try:
            found = function()
        except (probation.InputError, probation.ConvergenceError):
            return False
    for array in found if isinstance(found, tuple) else (found,):
        assert np.isfinite(array).all()
    return True


@thorough
@given(laws(), histories(), st.sampled_from(("be2", "sa2", "sa3", "exact")))
def test_stress(law, history, scheme):
    finite_or_refused(lambda: law.stress(*history, scheme))
    rate = history[1][::-1].copy()
    finite_or_refused(lambda: law.stress(StrainHistory(*history, jumps=None, strain_rate=rate), scheme=scheme))


@settings(thorough, max_examples=EXAMPLES // 2)
@given(laws(), histories())
def test_stress_by_cvode(law, history):
    finite_or_refused(lambda: law.stress(*history, probation.CVODE(max_steps=300)))


@thorough
@given(laws(), histories(), st.sampled_from(("be2", "sa2", "sa3")))
def test_sensitivities(law, history, scheme):
    finite_or_refused(lambda: law.sensitivity(*history, scheme))
    finite_or_refused(lambda: law.strain_sensitivity(*history, scheme))


@thorough
@given(laws(), histories(), st.sampled_from(("be2", "sa3")), st.lists(not_negative, min_size=9, max_size=9))
def test_batches(law, history, scheme, numbers):
    sets = np.array(numbers).reshape(3, 3)
    time, strain = history
    try:
        record = batch.Observed(StrainHistory(time, strain), np.full(len(time), numbers[0]))
    except probation.InputError:
        return
    for parameters in (sets, np.stack([law.parameters] * 4)):
        finite_or_refused(lambda parameters=parameters: batch.stresses(law, parameters, record.history, scheme))
        finite_or_refused(lambda parameters=parameters: batch.sums_of_squares(law, parameters, [record], scheme))
        finite_or_refused(lambda parameters=parameters: batch.many_normal_equations(law, parameters, [record], scheme))
    finite_or_refused(lambda: batch.normal_equations(law, record, scheme))
    finite_or_refused(lambda: batch.field_stresses(law, time, np.stack([strain, strain]), scheme=scheme))


@thorough
@given(laws(), histories(), st.lists(finite, min_size=8, max_size=8))
def test_identification_in_bulk(law, history, stress):
    """Solved records have parameters and errors; an error of a record that does not tell is inf, and says so."""
    time, strain = history
    found = probation.identify_many(law, time, strain, np.array(stress)[: len(time)])
    solved = np.isin(found.status, probation.bulk.SOLVED)
    assert np.isfinite(found.parameters[solved]).all()
    assert np.isfinite(found.rms_residual[solved]).all()
    assert np.isfinite(found.standard_error[found.status == 0]).all()


@thorough
@given(laws(), finite, st.lists(not_negative, min_size=1, max_size=5))
def test_ramps(law, rate, time):
    finite_or_refused(lambda: probation.ramp_stress(law, rate, np.array(time)))


@thorough
@given(laws(), histories(), st.lists(st.floats(0.0, 100.0) | finite, min_size=8, max_size=8))
def test_creep(law, history, stress):
    finite_or_refused(lambda: probation.creep(law, history[0], np.array(stress)[: len(history[0])]))


@thorough
@given(st.lists(strains | finite, max_size=5))
def test_haward_thackray_strain(strain):
    finite_or_refused(lambda: probation.haward_thackray_strain(np.array(strain, dtype=float)))


@thorough
@given(laws(), st.lists(finite, min_size=1, max_size=5))
def test_companion_relations(law, rate):
    if law.companion is not None:
        finite_or_refused(lambda: law.companion.relaxation_time(rate))
        finite_or_refused(lambda: law.companion.weissenberg_number(rate))


@thorough
@given(st.integers(1, 20), not_negative)
def test_spectra(modes, decades):
    def made():
        spectrum = probation.Spectrum.log_spaced(modes, decades)
        return spectrum.relaxation_ratio, spectrum.modal_weight

    finite_or_refused(made)


LAW = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)


def test_ordinary_numbers_are_not_refused():
    time = np.linspace(0.0, 10.0, 11)
    assert finite_or_refused(lambda: LAW.stress(time, 0.01 * time))
    assert finite_or_refused(lambda: LAW.strain_sensitivity(time, 0.01 * time))
    assert finite_or_refused(lambda: probation.ramp_stress(LAW, 1e5, [0.0, 1e-3]))


def test_a_stress_that_is_not_finite_says_when():
    with pytest.raises(probation.ConvergenceError, match=r"stress is not finite at t = 2 s \(sample 2\)") as caught:
        probation.Law(unrelaxed_modulus=1.0, tau_max=5.2, hardening_modulus=1e200).stress(
            [0.0, 1.0, 2.0], [0.0, 0.1, 200.0]
        )
    assert caught.value.time == 2.0


def test_of_many_solves_the_one_that_is_not_finite_is_named():
    history = StrainHistory([0.0, 1.0, 2.0], [0.0, 0.1, 200.0])
    record = batch.Observed(history, np.zeros(3))
    sets = [[1.0, 5.2, 1.0], [1.0, 5.2, 1e200]]
    with pytest.raises(probation.ConvergenceError, match=r"parameters\[1\]: the stress is not finite at t = 2 s"):
        batch.stresses(LAW, sets, history)
    with pytest.raises(probation.InputError, match=r"parameters\[0\], records\[0\]: .* sum of squares"):
        batch.sums_of_squares(LAW, sets, [record])
    with pytest.raises(probation.InputError, match=r"parameters\[0\], records\[0\]: .* squares are not finite"):
        batch.many_normal_equations(LAW, sets, [record])
    wild = probation.Law(unrelaxed_modulus=1.0, tau_max=5.2, hardening_modulus=1e200)
    with pytest.raises(probation.ConvergenceError, match="pixel 1: the stress is not finite at t = 2 s"):
        batch.field_stresses(wild, [0.0, 1.0, 2.0], [[0.0, 0.1, 0.2], [0.0, 0.1, 200.0]])


def test_steps_that_the_kernels_take_for_zero_are_refused_and_the_shortest_others_have_slopes():
    """At h / tau below 2.2e-308 the step moves no mode: all is elastic, and so are the slopes."""
    strain = np.linspace(0.0, 0.011, 12)
    with pytest.raises(probation.InputError, match=r"time\[1\] is .*; the step to it is too long or too short"):
        LAW.stress(np.arange(12) * 1e-309, strain)
    elastic = 3220.0 * np.eye(12)
    elastic[:, 0] -= 3220.0
    elastic[0, 0] = 0.0
    relaxed = np.outer(np.ones(12), np.eye(12)[0]) * 2.5 * 3.0
    for scheme in ("sa2", "sa3"):
        found = LAW.strain_sensitivity(np.arange(12) * 1e-307, strain, scheme)
        np.testing.assert_allclose(found, elastic + relaxed, rtol=1e-12, atol=1e-9)


def test_a_strain_beyond_all_stretches_is_named():
    with pytest.raises(probation.InputError, match=r"true_strain\[1\] is 400; its stretch is beyond all numbers"):
        probation.haward_thackray_strain([0.1, 400.0])


def test_a_weissenberg_number_beyond_all_numbers_is_refused():
    with pytest.raises(probation.InputError, match=r"rate is 1e\+200 1/s; its Weissenberg number"):
        probation.PowerLaw(1e150, 0.0).weissenberg_number([1.0, 1e200])


def test_decades_that_no_number_spans_are_refused():
    with pytest.raises(probation.InputError, match="decades is 400; a positive number of at most 300"):
        probation.Spectrum.log_spaced(50, 400.0)
