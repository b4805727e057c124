"""`Law.stress` solves in memory that its thread keeps: no call may remember another."""

from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import probation
from probation import Law, Modification, StressActivation, Weissenberg
from probation.law.modified import engine_change
from probation.law.schemes import make_solver

EVEN = np.linspace(0.0, 100.0, 301)
UNEVEN = np.cumsum(np.random.default_rng(5).uniform(0.05, 0.6, 173))
LAWS = (
    Law(unrelaxed_modulus=3220.0, tau_max=5.2, hardening_modulus=2.5),
    Law(unrelaxed_modulus=2000.0, hardening_modulus=1.5, companion=Weissenberg(0.00464, 0.0367)),
    Law(unrelaxed_modulus=1000.0, tau_max=2.0, hardening_modulus=1.0, modes=7),
)
CHANGES = (
    None,
    Modification(relaxation_time_factor=0.7, extra_modulus=[30.0], extra_relaxation_time=[4.0]),
    Modification(feedbacks=(StressActivation(20.0),)),
    Modification(initial_modal_stress=np.linspace(0.0, 1.0, 50)),
)


def cases():
    """Every scheme, law, grid and change that go together, in an order in which they disturb each other most."""
    made = []
    for change in CHANGES:
        for law in LAWS:
            for scheme in ("be2", "sa2", "sa3"):
                for time, rate in ((EVEN, 0.005), (UNEVEN, 0.01), (EVEN[:2], 0.02), (EVEN[:90], -0.001)):
                    if change is not CHANGES[3] or law.modes == 50:
                        made.append((law, change, scheme, time, rate * time))
    return [made[k] for k in np.random.default_rng(1).permutation(len(made))]


def alone(law, change, scheme, time, strain):
    """By a solver of its own."""
    solver, stress = make_solver(probation.StrainHistory(time, strain).engine, scheme), np.empty(len(time))
    solver.stress(law.engine, engine_change(change), stress)
    return stress


def differing(made):
    """Which of these calls give another answer than alone, to the last bit."""
    answers = [law.stress(time, strain, scheme, modification=change) for law, change, scheme, time, strain in made]
    return [k for k, answer in enumerate(answers) if not np.array_equal(answer, alone(*made[k]))]


def test_the_answer_does_not_depend_on_the_calls_before():
    assert differing(cases()) == []


def test_threads_do_not_disturb_each_other():
    with ThreadPoolExecutor(3) as pool:
        assert list(pool.map(differing, [cases()[::2], cases()[1::2], cases()[::3]])) == [[], [], []]


@pytest.mark.parametrize("scheme", ["be2", "cvode"])
def test_a_call_that_was_refused_leaves_nothing_behind(scheme):
    law, strain = LAWS[0], 0.005 * EVEN
    before = law.stress(EVEN, strain, scheme)
    with pytest.raises(probation.InputError, match=r"time\[4\]"):
        law.stress([0.0, 1.0, 2.0, 3.0, 3.0], np.zeros(5), scheme)
    with pytest.raises(probation.InputError, match=r"true_strain\[7\] is nan"):
        law.stress(EVEN, np.where(np.arange(301) == 7, np.nan, strain), scheme)
    with pytest.raises(probation.InputError, match="load_bearing_area"):
        law.stress(EVEN, strain, scheme, modification=Modification(load_bearing_area=np.ones(5)))
    np.testing.assert_array_equal(law.stress(EVEN, strain, scheme), before)


def test_a_record_too_long_to_be_kept_is_solved_all_the_same():
    time = np.linspace(0.0, 10.0, 100_002)
    long, short = 0.01 * time, 0.005 * EVEN
    for _ in range(2):
        np.testing.assert_array_equal(
            LAWS[2].stress(time, long, "sa3"), alone(LAWS[2], None, "sa3", time, long), strict=True
        )
        np.testing.assert_array_equal(LAWS[2].stress(EVEN, short), alone(LAWS[2], None, "be2", EVEN, short))


@pytest.mark.parametrize(
    "unready",
    [
        lambda a: a.tolist(),
        lambda a: a.astype(np.float32),
        lambda a: a.astype(">f8"),
        lambda a: np.repeat(a, 2)[::2],
        lambda a: np.ma.masked_array(a, mask=np.zeros(len(a), dtype=bool)),
        lambda a: a.view(type("Subclass", (np.ndarray,), {})),
    ],
)
def test_samples_that_are_not_where_the_engine_can_read_them_give_the_same_stress(unready):
    time = np.arange(0.0, 40.0)  # exact in float32, too
    strain = time / 1024.0
    expected, out = LAWS[0].stress(time, strain), np.empty(40)
    np.testing.assert_array_equal(LAWS[0].stress(unready(time), unready(strain)), expected)
    assert LAWS[0].stress(time, unready(strain), out=out) is out
    np.testing.assert_array_equal(out, expected)


def test_a_masked_sample_and_an_output_that_does_not_fit_are_refused():
    strain = 0.005 * EVEN
    with pytest.raises(probation.InputError, match="masked"):
        LAWS[0].stress(EVEN, np.ma.masked_less(strain, 0.1))
    with pytest.raises(probation.InputError, match="as in time"):
        LAWS[0].stress(EVEN, strain[:-1])
    for out in (np.empty(300), np.empty(301, dtype=np.float32), np.empty(602)[::2], np.empty((301, 1)), [0.0] * 301):
        with pytest.raises(probation.InputError, match=r"out must be .*\(301,\)"):
            LAWS[0].stress(EVEN, strain, out=out)
