"""Do the alternatives of bench/ solve the same problem, so that their times may be compared?"""

import importlib.util
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose

sys.path.append(str(Path(__file__).resolve().parents[2]))

from bench import cases, methods, reference
from bench.python import engine

import probation

needs_numba = pytest.mark.skipif(importlib.util.find_spec("numba") is None, reason="numba is not installed")


def test_the_closed_form_of_the_bench_is_that_of_the_engine():
    case = cases.ramp()
    assert_allclose(probation.ramp_stress(engine.law_of(case), cases.RATE, case.time), case.exact, atol=1e-11)


def test_the_reference_for_smooth_histories_meets_the_closed_form_on_a_ramp():
    time = np.linspace(0.0, 20.0, 101)
    found = reference.smooth(
        time, lambda t: cases.RATE * t, lambda t: np.full_like(t, cases.TAU_MAX), cases.E_U, cases.G
    )
    assert_allclose(found, reference.ramp(time, cases.RATE, cases.E_U, cases.TAU_MAX, cases.G), atol=1e-10)


def test_the_engine_is_exact_on_the_rate_jump_of_the_bench():
    """Strain is piecewise linear and tau_max constant there: what the scheme `exact` is exact for."""
    case = cases.jump()
    assert case.error(engine.prepare(case, "exact")()) < 1e-10


def test_numpy_as_printed_is_the_engine_with_the_first_step_of_the_paper():
    case = cases.ramp(200)
    expected = methods.BE2_PAPER.prepare(case)()
    for method in (methods.NUMPY_NAIVE, methods.NUMPY):
        assert_allclose(method.prepare(case)(), expected, atol=1e-10)


def test_lfilter_is_the_sa2_of_the_engine():
    case = cases.ramp(200)
    assert_allclose(methods.LFILTER.prepare(case)(), methods.SA2.prepare(case)(), atol=1e-10)


@pytest.mark.parametrize("method", [methods.BDF, methods.LSODA], ids=lambda method: method.key)
def test_a_general_solver_comes_near_the_closed_form(method):
    """Fifty modes, each to 1e-6 of stresses below 170 MPa."""
    case = cases.ramp(200)
    assert case.error(method.prepare(case)()) < 170 * 1e-6 * 50


@needs_numba
@pytest.mark.filterwarnings("default")
def test_numba_gives_what_the_engine_gives():
    case, uneven = cases.ramp(200), cases.uneven_ramp(200)
    expected = methods.BE2_PAPER.prepare(case)()
    for method in (methods.NUMBA_BE2, methods.NUMBA_HOISTED, methods.NUMBA_FASTMATH):
        assert_allclose(method.prepare(case)(), expected, atol=1e-10)
    assert_allclose(methods.NUMBA_SA2.prepare(case)(), methods.SA2.prepare(case)(), atol=1e-10)
    assert_allclose(methods.NUMBA_BE2_VARIABLE.prepare(uneven)(), methods.BE2_PAPER.prepare(uneven)(), atol=1e-10)
    assert_allclose(methods.NUMBA_SA2_VARIABLE.prepare(uneven)(), methods.SA2.prepare(uneven)(), atol=1e-10)
