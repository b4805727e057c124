"""Identification in bulk against scipy's path, and what becomes of bad records."""

import multiprocessing
import os
import signal
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from numpy.testing import assert_allclose

import probation
from probation import BulkIdentification, Law, PowerLaw, Record, StrainHistory, Weissenberg, bulk, identify_many
from probation.identify.covariance import covariance
from probation.identify.search import by_least_squares, first_guess
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.records.record import Noise
from probation.smoothing.excitation import excite

LAW = Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
TIME = np.linspace(0.0, 100.0, 201)
STRAIN = 0.004 * TIME + 0.01 * np.sin(0.05 * TIME)
COMPANIONS = (None, Weissenberg(0.00464, 0.0367), PowerLaw(0.03, -0.9))


def noisy(records=6, law=LAW, noise=0.04, seed=0):
    stress = law.stress(TIME, STRAIN, "sa3")
    return stress + noise * np.random.default_rng(seed).normal(size=(records, len(TIME)))


def by_scipy(law, time, strain, stress, scheme, held=(False, False, False)):
    """The estimates of `fit`'s own search, their white standard errors, and their cost.

    Where the data hardly tell a parameter, that search stops a few 1e-6 short: a Gauss-Newton step takes it on.
    """
    record = Record("a", time, strain, stress, control="other", noise=Noise(1.0))
    names = [name for name, fixed in zip(law.parameter_names, held, strict=True) if fixed]
    jumps = tuple(int(jump) for jump in StrainHistory(time, strain).jumps)
    view = replace(measured_view(record, excite(record, "raw"), scheme), jumps=jumps)
    problem = Problem.white(DnlrLaw(law, names), [view])
    limits = dict.fromkeys(law.parameter_names, (0.0, np.inf))
    best = by_least_squares(problem, first_guess(problem, limits), limits)
    residual, jacobian = problem.residual_and_jacobian(best)
    known = covariance(jacobian, residual, [len(time)], best)
    cost = float(residual @ residual)
    step = np.linalg.lstsq(jacobian * best, -residual, rcond=None)[0]
    if np.abs(step).max() < 1e-4:
        best = best * (1.0 + step)
    return problem.law_at(best).parameters, known, cost


def random_record(seed):
    """A record of any kind: shape, grid, noise, bias, law, scheme; some say next to nothing about the parameters."""
    rng = np.random.default_rng(seed)
    n, duration = int(rng.integers(30, 160)), 10.0 ** rng.uniform(0.5, 3.5)
    steps = np.ones(n - 1) if rng.random() < 0.5 else rng.uniform(0.3, 1.7, n - 1)
    x = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    shapes = [x, x**1.5, np.minimum(x, 0.5) * 2.0, x - 0.8 * np.maximum(x - 0.6, 0.0)]
    strain = 10.0 ** rng.uniform(-1.5, 0.3) * shapes[rng.integers(4)]
    companion = COMPANIONS[rng.integers(3)]
    scale = 10.0 ** rng.uniform(-0.5, 0.5)
    time_parameter = {"tau_max": scale * duration / 50.0} if companion is None else {"alpha": scale}
    law = Law(
        unrelaxed_modulus=10.0 ** rng.uniform(2.0, 4.0),
        hardening_modulus=rng.uniform(0.5, 5.0),
        companion=companion,
        **time_parameter,
    )
    scheme = ("be2", "sa2", "sa3")[rng.integers(3)]
    stress = law.stress(duration * x, strain, "sa3")
    size = np.ptp(stress)
    stress += 10.0 ** rng.uniform(-4.0, -1.5) * size * rng.normal(size=n)
    if rng.random() < 0.3:
        stress += 0.02 * size * np.sin(6.0 * x)
    return law, duration * x, strain, stress, scheme


@pytest.mark.parametrize("seed", range(40))
def test_both_methods_give_what_scipy_gives(seed):
    """Relative 1e-6; or a lower cost, where scipy's search ends in another valley."""
    law, time, strain, stress, scheme = random_record(seed)
    expected, known, least = by_scipy(law, time, strain, stress, scheme)
    for method in bulk.METHODS:
        found = identify_many(law, time, strain, stress, scheme, method=method, threads=1)
        assert found.status[0] in bulk.SOLVED
        stress_found = law.with_parameters(found.parameters[0]).stress(time, strain, scheme)
        cost = float(np.sum((stress_found - stress) ** 2))
        if found.status[0] == 1:  # an end of the range of tau_max: scipy's search may go beyond it
            assert cost <= least * (1.0 + 1e-9) or not 1e-3 < found.parameters[0, 1] < 1e3
        elif cost >= least * (1.0 - 1e-6):
            assert_allclose(found.parameters[0], expected, rtol=1e-6)
            if not known.correlated:
                assert_allclose(found.standard_error[0] / expected, known.relative_error, rtol=1e-3)


@pytest.mark.parametrize(("scheme", "order"), [("be2", 2), ("sa2", 2)])
@pytest.mark.parametrize("method", bulk.METHODS)
def test_substeps_take_the_error_of_the_scheme_out(scheme, order, method):
    """A record of 51 instants, its stress by SA3 on 64 steps between them: four times the steps, a sixteenth of it."""
    time = np.linspace(0.0, 100.0, 50 * 64 + 1)
    strain = 0.4 * (time / 100.0) ** 2
    stress = LAW.stress(time, strain, "sa3")[::64]
    shifts = []
    for substeps in (4, 16):
        every = 64 // substeps
        found = identify_many(
            LAW, time[::every], strain[::every], stress, scheme, method=method, substeps=substeps, noise=0.1
        )
        assert found.converged.all()
        shifts.append(np.abs(found.parameters[0] / LAW.parameters - 1.0).max())
    assert shifts[1] < 1e-3
    assert shifts[0] / shifts[1] == pytest.approx(4.0**order, rel=0.25)


def test_a_sampled_record_with_substeps_is_as_long_as_its_samples_say():
    with pytest.raises(probation.InputError, match=r"true_stress \(6, 201\); expected .* \(n_samples - 1\) \* 2 \+ 1"):
        identify_many(LAW, TIME, STRAIN, noisy(), substeps=2)
    with pytest.raises(probation.InputError, match=r"true_stress \(6, 67\)"):
        identify_many(LAW, TIME, STRAIN, noisy()[:, ::3], substeps=3)
    for wrong in (0, 1.5, True, "auto"):
        with pytest.raises(probation.InputError, match=r"substeps is .*; expected a whole number from 1 to"):
            identify_many(LAW, TIME, STRAIN, noisy(), substeps=wrong)


def test_held_parameters_stay_and_the_others_are_those_of_scipy():
    stress = noisy(1, noise=0.1)
    other = LAW.with_parameters([1000.0, 1.0, 1.0])
    found = identify_many(other, TIME, STRAIN, stress, hold={"unrelaxed_modulus_MPa": 3220.0})
    expected, known, _ = by_scipy(LAW, TIME, STRAIN, stress[0], "sa3", (True, False, False))
    assert_allclose(found.parameters[0], expected, rtol=1e-6)
    assert_allclose(found.standard_error[0, 1:], known.relative_error * expected[1:], rtol=1e-4)
    assert found.standard_error[0, 0] == 0.0
    only = identify_many(LAW, TIME, STRAIN, stress, hold={"tau_max_s": 5.1, "hardening_modulus_MPa": 2.4})
    assert_allclose(only.parameters[0, 1:], [5.1, 2.4], rtol=0.0)


def test_weights_are_those_of_a_weighted_fit():
    """A sample of noise 10^6 times that of the others is as good as not there: its stress may be anything."""
    stress = noisy(1)
    noise = np.ones(len(TIME))
    noise[50] = 1e9
    torn = stress.copy()
    torn[0, 50] += 50.0
    kept = identify_many(LAW, TIME, STRAIN, stress, noise=noise)
    found = identify_many(LAW, TIME, STRAIN, torn, noise=noise)
    assert_allclose(found.parameters, kept.parameters, rtol=1e-6)
    level = identify_many(LAW, TIME, STRAIN, stress, noise=7.0)
    plain = identify_many(LAW, TIME, STRAIN, stress)
    assert_allclose(level.parameters, plain.parameters, rtol=1e-8)
    assert_allclose(level.standard_error, plain.standard_error, rtol=1e-6)
    assert_allclose(level.rms_residual, plain.rms_residual, rtol=1e-8)


def test_standard_errors_are_what_estimates_scatter():
    """400 records: the ratio is known to 1 / sqrt(800), 3.5 %."""
    found = identify_many(LAW, TIME, STRAIN, noisy(400))
    assert found.converged.all()
    assert_allclose(found.parameters.std(axis=0) / found.standard_error.mean(axis=0), 1.0, atol=0.15)
    assert_allclose(found.rms_residual.mean(), 0.04, rtol=0.02)


@pytest.mark.parametrize("threads", [2, 3, None])
def test_the_answer_depends_on_neither_threads_nor_neighbours(threads):
    stress = noisy(20)
    alone = [identify_many(LAW, TIME, STRAIN, one, threads=1).parameters[0] for one in stress]
    together = identify_many(LAW, TIME, np.tile(STRAIN, (20, 1)), stress, threads=threads)
    assert np.array_equal(together.parameters, alone)


def test_single_precision_is_read_as_it_is():
    stress = noisy(4).astype(np.float32)
    found = identify_many(LAW, TIME.astype(np.float32), STRAIN, stress)
    expected = identify_many(LAW, TIME, STRAIN, stress.astype(np.float64))
    assert_allclose(found.parameters, expected.parameters, rtol=1e-12)  # these times have no more digits
    assert_allclose(
        found.parameters, identify_many(LAW, TIME, STRAIN, np.asfortranarray(stress)).parameters, rtol=1e-12
    )


def test_one_bad_pixel_stops_nothing():
    stress, strain = noisy(7), np.tile(STRAIN, (7, 1))
    time = np.tile(TIME, (7, 1))
    stress[1, 100:] = np.nan
    strain[2, 7] = np.inf
    time[3, [10, 11]] = time[3, [11, 10]]
    strain[4] = 1e4
    strain[5] = 0.0
    found = identify_many(LAW, time, strain, stress)
    words = [bulk.STATUS_WORDS[int(number)] for number in found.status]
    assert words[1:6] == ["not finite", "not finite", "times do not increase", "not finite", "not determined"]
    assert found.counts() == {"converged": 2, "not determined": 1, "not finite": 3, "times do not increase": 1}
    assert np.isnan(found.parameters[1:5]).all()
    assert np.isnan(found.rms_residual[1:5]).all()
    assert np.isinf(found.standard_error[5]).all()
    expected = identify_many(LAW, TIME, STRAIN, stress[[0, 6]])
    assert np.array_equal(found.parameters[[0, 6]], expected.parameters)


def test_masked_samples_are_bad_samples():
    stress = np.ma.masked_array(noisy(2), mask=False)
    stress[1, 3] = np.ma.masked
    assert identify_many(LAW, TIME, STRAIN, stress).status.tolist() == [0, 4]


def test_too_few_samples_and_impossible_rates_are_told():
    found = identify_many(LAW, TIME[:3], STRAIN[:3], noisy(2)[:, :3])
    assert set(found.counts()) == {"too few samples"}
    law = Law(unrelaxed_modulus=3220.0, alpha=1.0, hardening_modulus=1.8, companion=Weissenberg(0.02, 0.06))
    slow = identify_many(law, TIME * 1e3, STRAIN, noisy(1))
    assert set(slow.counts()) == {"impossible rate"}


def test_output_is_used_again():
    out = BulkIdentification.empty(6)
    assert identify_many(LAW, TIME, STRAIN, noisy(), out=out) is out
    with pytest.raises(probation.InputError, match=r"out\.parameters"):
        identify_many(LAW, TIME, STRAIN, noisy(5), out=out)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"scheme": "exact"}, "be2, sa2, sa3"),
        ({"method": "simplex"}, "variable-projection"),
        ({"hold": {"alpha": 1.0}}, "tau_max_s"),
        ({"hold": {"tau_max_s": -1.0}}, "tau_max"),
        (
            {"hold": {"unrelaxed_modulus_MPa": 1.0, "tau_max_s": 1.0, "hardening_modulus_MPa": 1.0}},
            "every parameter is held",
        ),
        ({"bounds": {"tau_max_s": (2.0, 1.0)}}, "0 <= lower < upper"),
        ({"noise": np.ones(3)}, r"\(6, 201\)"),
        ({"true_strain": STRAIN[:-1]}, r"true_strain \(200,\)"),
        ({"true_stress": np.zeros((2, 2, 2))}, r"\(records, n_times\)"),
        ({"true_stress": [["a", "b"]]}, "real numbers"),
        ({"jumps": "some"}, "auto"),
    ],
)
def test_arguments_that_do_not_fit_are_named(change, said):
    arguments = {"time": TIME, "true_strain": STRAIN, "true_stress": noisy()} | change
    with pytest.raises(probation.InputError, match=said):
        identify_many(LAW, **arguments)


def _in_child(stress):
    return identify_many(LAW, TIME, STRAIN, stress, threads=2).parameters


def test_a_forked_process_identifies_too():
    """The pool's threads do not cross a fork; the child makes its own."""
    stress = noisy(8)
    here = identify_many(LAW, TIME, STRAIN, stress, threads=2).parameters
    with multiprocessing.get_context("fork").Pool(2) as pool:
        there = pool.map(_in_child, [stress, stress])
    assert np.array_equal(there[0], here)
    assert np.array_equal(there[1], here)


INTERRUPTED = """
import signal
import numpy as np
import probation
signal.signal(signal.SIGINT, signal.default_int_handler)  # what runs in the background is born deaf to it
law = probation.Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5)
time = np.linspace(0.0, 100.0, 401)
stress = np.tile(law.stress(time, 0.005 * time).astype(np.float32), (50_000, 1))
try:
    print("ready", flush=True)
    probation.identify_many(law, time, 0.005 * time, stress)
    print("finished", flush=True)
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""


def test_an_interrupt_ends_a_long_batch():
    with subprocess.Popen([sys.executable, "-c", INTERRUPTED], stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout.readline() == "ready\n"
        os.kill(process.pid, signal.SIGINT)
        assert process.stdout.readline() == "interrupted\n"
    assert process.returncode == 0


@pytest.mark.parametrize("scale", [1e200, 1e-160])
def test_stresses_beyond_all_sizes_get_a_status(scale):
    found = identify_many(LAW, TIME, STRAIN, LAW.stress(TIME, STRAIN, "sa3") * scale, threads=1)
    assert bulk.STATUS_WORDS[int(found.status[0])] == "not finite"
    assert np.isnan(found.parameters).all()


@pytest.mark.parametrize("scale", [1e-200, 1e200])
def test_only_ratios_of_the_noise_matter_at_any_scale(scale):
    stress = LAW.stress(TIME, STRAIN, "sa3") + 0.1 * np.random.default_rng(1).standard_normal(len(TIME))
    noise = 1.0 + 0.5 * np.sin(TIME)
    expected = identify_many(LAW, TIME, STRAIN, stress, noise=noise, threads=1)
    found = identify_many(LAW, TIME, STRAIN, stress, noise=noise * scale, threads=1)
    assert found.status[0] == 0
    assert_allclose(found.parameters, expected.parameters, rtol=1e-9)
    assert_allclose(found.rms_residual, expected.rms_residual, rtol=1e-9)


def test_a_relaxation_time_of_a_few_samples_is_found_where_the_thinned_record_hides_it():
    time = np.linspace(0.0, 100.0, 401)
    strain = np.interp(time, [0.0, 10.0, 100.0], [0.0, 0.1, 0.4])
    law = Law(unrelaxed_modulus=3000.0, tau_max=0.35, hardening_modulus=2.0)
    stress = law.stress(time, strain, "sa3")
    noisy = stress + 0.025 * stress.max() * np.random.default_rng(0).standard_normal((1000, len(time)))
    records = noisy[[0, 1, 2, 436]]
    found = identify_many(law, time, strain, records)
    nearby = identify_many(law, time, strain, records, bounds={"tau_max_s": (0.01, 10.0)})
    assert (found.rms_residual <= nearby.rms_residual * (1.0 + 1e-9)).all()


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        ({"hold": 3}, "hold"),
        ({"hold": "tau_max_s"}, "hold"),
        ({"hold": {"tau_max_s": "5"}}, "hold of tau_max_s"),
        ({"bounds": [(0, 1)]}, "bounds"),
        ({"bounds": {"tau_max_s": 3}}, "tau_max"),
        ({"bounds": {"tau_max_s": "12"}}, "tau_max"),
        ({"bounds": {"tau_max_s": (1,)}}, "tau_max"),
        ({"bounds": {"tau_max_s": ("a", "b")}}, "tau_max"),
        ({"noise": [[1], [1, 2]]}, "noise"),
        ({"jumps": np.array([1.0])}, "jumps"),
        ({"threads": 0}, "threads is 0; expected at least 1"),
        ({"threads": 1.5}, "threads"),
        ({"out": 3}, "out"),
    ],
)
def test_an_argument_of_another_kind_is_named(arguments, named):
    with pytest.raises(probation.InputError, match=named):
        identify_many(LAW, TIME, STRAIN, STRAIN, **arguments)
    with pytest.raises(probation.InputError, match="law"):
        identify_many(3, TIME, STRAIN, STRAIN)


def test_records_in_the_memory_of_the_answer_are_read_first():
    stress = noisy(300)
    expected = identify_many(LAW, TIME, STRAIN, stress)
    memory = np.empty(300 * len(TIME))
    inside = memory.reshape(300, -1)
    inside[:] = stress
    out = replace(BulkIdentification.empty(300), parameters=memory[:900].reshape(300, 3), rms_residual=memory[900:1200])
    identify_many(LAW, TIME, STRAIN, inside, threads=1, out=out)
    assert_allclose(out.parameters, expected.parameters, rtol=0.0)
    assert_allclose(out.rms_residual, expected.rms_residual, rtol=0.0)


def test_answers_that_share_memory_are_refused():
    memory = np.empty((6, 3))
    out = replace(BulkIdentification.empty(6), parameters=memory, standard_error=memory)
    with pytest.raises(probation.InputError, match=r"out\.parameters and out\.standard_error share memory"):
        identify_many(LAW, TIME, STRAIN, noisy(), out=out)
