"""The identification problem: never changed, so that no answer depends on what was asked before."""

from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import probation
from probation import Law, Record
from probation.effects.cause import Cause
from probation.effects.registry import effect
from probation.identify.profile import profile
from probation.identify.search import by_least_squares
from probation.identify.weighting import Weighted, known_of
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.inference.problem import Problem
from probation.inference.strain_noise import StrainNoise
from probation.smoothing.excitation import excite

LAW = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
LIMITS = dict.fromkeys(LAW.parameter_names, (0.0, np.inf))
START, AWAY = LAW.parameters, LAW.parameters * [0.9, 1.1, 1.02]


def problem(samples=80):
    """A ramp whose strain noise moves with the law."""
    random = np.random.default_rng(5)
    time = np.linspace(0.0, 400.0, samples)
    stress = probation.ramp_stress(LAW, 0.005, time) + 0.04 * random.normal(size=samples)
    record = Record("ramp", time, 0.005 * time + 3e-4 * random.normal(size=samples), stress, control="strain-rate")
    view = measured_view(record, excite(record, "raw"), "sa3")
    white = Problem.white(DnlrLaw(LAW), [view])
    strain = replace(StrainNoise.of(view.excitation, "sa3"), deviation=3e-4)
    return white.with_noises(white.whitener.noises, [strain])


def test_nothing_in_it_can_be_set():
    for name in ("model", "law", "whitener", "moving"):
        with pytest.raises(FrozenInstanceError):
            setattr(problem(), name, None)


def test_on_some_records_each_keeps_its_noise():
    """Rows of the second record alone, whatever stands before it; its strain noise goes with it."""
    view, moving = problem().views[0], problem().moving
    both = Problem.white(DnlrLaw(LAW), [replace(view, id="first"), view], [0.1, 0.2])
    both = both.with_noises(both.whitener.noises, [None, *moving.strain])
    second = both.only([1])
    assert_allclose(second.residual(AWAY), both.residual(AWAY)[len(view) :], rtol=1e-12)
    assert second.carries_strain_noise
    assert not both.only([0]).carries_strain_noise


def test_a_search_and_a_profile_leave_it_as_it_was():
    """The residual at one law, before and after the noise was asked for at many others."""
    asked = problem()
    before = asked.residual_and_jacobian(AWAY)
    best = by_least_squares(asked, START, LIMITS)
    weighted = Weighted(asked, best)
    first = profile(weighted, known_of(weighted)[0], 2, 1.99, LIMITS)
    for then, now in zip(before, asked.residual_and_jacobian(AWAY), strict=True):
        assert_array_equal(now, then)
    again = profile(weighted, known_of(weighted)[0], 2, 1.99, LIMITS)
    assert again.interval95 == first.interval95


def test_the_noise_of_a_law_is_that_of_a_problem_made_for_it():
    """Moving to it and back, or frozen there: one answer."""
    asked = problem()
    asked.residual(START)
    asked.residual(1.2 * START)
    assert_allclose(asked.residual(AWAY), problem().residual(AWAY), rtol=1e-12)
    assert_array_equal(asked.frozen_at(AWAY).residual(AWAY), asked.residual(AWAY))
    assert asked.frozen_at(AWAY).moving is None


def test_what_differs_is_another_problem():
    asked = problem()
    held = asked.with_law(asked.law.holding("tau_max", LAW.with_parameters(AWAY)))
    assert (list(held.law.free), list(asked.law.free)) == ([0, 2], [0, 1, 2])
    assert held.law_at(np.array([1.0, 2.0])).tau_max == AWAY[1]
    fine = asked.with_views(view.with_substeps(4) for view in asked.views)
    assert (fine.views[0].stride, asked.views[0].stride) == (4, 1)
    white = asked.reweighed(AWAY)
    assert_allclose(np.sqrt(np.mean(white.residual(AWAY) ** 2)), 1.0)
    assert asked.moving is not None


def test_effects_join_the_parameters_of_the_law_in_the_same_problem():
    """Absent they change nothing; the law's columns stay, and the noise is the records'."""
    asked = problem().frozen_at(START)
    known = effect("force_drift")
    joined = asked.with_causes([Cause(known, known.forms[0])])
    parameters = joined.model.parameters(AWAY, (0.0, *known.forms[0].typical[1:]))
    residual, jacobian = joined.residual_and_jacobian(parameters)
    alone = asked.residual_and_jacobian(AWAY)
    assert_allclose(residual, alone[0], rtol=1e-9, atol=1e-9)
    assert_allclose(jacobian[:, :3], alone[1], rtol=1e-9)
    assert joined.whitener is asked.whitener
    assert np.linalg.norm(jacobian[:, 3]) > 0.0
