"""Four threads at once: the same answers, and the interpreter free meanwhile."""

import threading
import time as clock
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest

import probation
from probation import Modification, SelfHeating
from probation.law.modified import engine_change
from probation.law.schemes import make_solver
from reference import paper

TIME = np.linspace(0.0, 60.0, 3001)
STRAIN = paper.smooth_strain(TIME)


def law(tau):
    return probation.Law(unrelaxed_modulus=3220.0, tau_max=tau, hardening_modulus=2.5)


@pytest.mark.parametrize("scheme", ["be2", "sa3", "exact", "cvode"])
def test_four_threads_give_what_one_gives(scheme):
    n = 201 if scheme == "cvode" else 3001

    def solve(tau):
        return law(tau).stress(TIME[:n], STRAIN[:n], scheme)

    taus = [1.0, 3.0, 5.0, 7.0] * (1 if scheme == "cvode" else 5)
    alone = [solve(tau) for tau in taus]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(solve, taus))
    assert all(np.array_equal(one, other) for one, other in zip(alone, together, strict=True))


def test_feedbacks_and_sensitivities_in_threads_give_what_one_gives():
    change = Modification(feedbacks=(SelfHeating(1.0, 0.01, 0.02, 0.01),))

    def solve(tau):
        return law(tau).sensitivity(TIME[:301], STRAIN[:301], modification=change)

    taus = [1.0, 3.0, 5.0, 7.0]
    alone = [solve(tau) for tau in taus]
    with ThreadPoolExecutor(4) as pool:
        together = list(pool.map(solve, taus))
    for one, other in zip(alone, together, strict=True):
        assert np.array_equal(one[0], other[0])
        assert np.array_equal(one[1], other[1])


@pytest.mark.parametrize("call", ["stress", "tangent", "strain_sensitivity"])
def test_the_interpreter_goes_on_during_a_call(call):
    """A call of some 0.1 s: with the lock held, no other thread would take a step before its end."""
    base = law(5.0)
    change = Modification(extra_modulus=np.ones(400), extra_relaxation_time=np.geomspace(1e-3, 1e3, 400))
    n = {"stress": 201, "tangent": 1001, "strain_sensitivity": 401}[call]
    scheme = "cvode" if call == "stress" else "sa3"
    solver = make_solver(probation.StrainHistory(TIME[:n] ** 1.01, STRAIN[:n]).engine, scheme)
    done = threading.Event()
    out, columns = np.empty(n), np.empty((n, 40))
    changed = engine_change(change)
    directions = [probation.Direction(relaxed_stress=1.0)._engine()] * 40

    def work():
        began.append(clock.perf_counter())
        if call == "stress":
            solver.stress(base.engine, changed, out)
        elif call == "tangent":
            solver.tangent(base.engine, changed, directions, out, columns)
        else:
            solver.strain_sensitivity(base.engine, changed)
        ended.append(clock.perf_counter())
        done.set()

    began, ended, ticks = [], [], []
    thread = threading.Thread(target=work)
    thread.start()
    while not done.wait(0.001):
        ticks.append(clock.perf_counter())
    thread.join()
    during = [tick for tick in ticks if began[0] < tick < ended[0]]
    assert len(during) >= 3, f"{len(during)} steps in {ended[0] - began[0]:.3f} s"
