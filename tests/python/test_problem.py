"""The identification problem: never changed, so that no answer depends on what was asked before."""

from dataclasses import FrozenInstanceError, replace

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

import probation
from probation import Law, Record
from probation.identify.profile import profile
from probation.identify.search import by_least_squares
from probation.identify.weighting import Weighted, known_of
from probation.inference.problem import Problem
from probation.inference.record_noise import RecordNoise
from probation.inference.record_problem import RecordProblem
from probation.inference.strain_noise import StrainNoise
from probation.smoothing.excitation import excite

LAW = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
LIMITS = dict.fromkeys(LAW.parameter_names, (0.0, np.inf))
AWAY = LAW.with_parameters(LAW.parameters * [0.9, 1.1, 1.02])


def problem(samples=80):
    """A ramp whose strain noise moves with the law."""
    random = np.random.default_rng(5)
    time = np.linspace(0.0, 400.0, samples)
    stress = probation.ramp_stress(LAW, 0.005, time) + 0.04 * random.normal(size=samples)
    record = Record("ramp", time, 0.005 * time + 3e-4 * random.normal(size=samples), stress, control="strain-rate")
    prepared = RecordProblem.prepare(record, excite(record, "raw"), "sa3")
    white = Problem.of(LAW, [prepared], (False, False, False))
    strain = replace(StrainNoise.of(prepared.excitation, "sa3"), deviation=3e-4)
    return white.with_noises([RecordNoise(white.noises[0].stress, strain)])


def test_nothing_in_it_can_be_set():
    for name in ("law", "records", "held", "noises"):
        with pytest.raises(FrozenInstanceError):
            setattr(problem(), name, None)


def test_a_search_and_a_profile_leave_it_as_it_was():
    """The residual at one law, before and after the noise was asked for at many others."""
    asked = problem()
    before = asked.residual_and_jacobian(AWAY)
    best = by_least_squares(asked, LAW, LIMITS)
    weighted = Weighted(asked, best)
    first = profile(weighted, known_of(weighted)[0], 2, 1.99, LIMITS)
    for then, now in zip(before, asked.residual_and_jacobian(AWAY), strict=True):
        assert_array_equal(now, then)
    again = profile(weighted, known_of(weighted)[0], 2, 1.99, LIMITS)
    assert again.interval95 == first.interval95


def test_the_noise_of_a_law_is_that_of_a_problem_made_for_it():
    """Moving to it and back, or frozen there: one answer."""
    asked = problem()
    asked.residual(LAW)
    asked.residual(LAW.with_parameters(LAW.parameters * 1.2))
    assert_allclose(asked.residual(AWAY), problem().residual(AWAY), rtol=1e-12)
    assert_array_equal(asked.frozen_at(AWAY).residual(AWAY), asked.residual(AWAY))
    assert not asked.frozen_at(AWAY).noise_moves


def test_what_differs_is_another_problem():
    asked = problem()
    held = asked.with_held(1, AWAY)
    assert (list(held.free), list(asked.free)) == ([0, 2], [0, 1, 2])
    assert held.law_at(np.array([1.0, 2.0])).tau_max == AWAY.tau_max
    fine = asked.with_records(each.with_substeps(4) for each in asked.records)
    assert (fine.records[0].substeps, asked.records[0].substeps) == (4, 1)
    white = asked.reweighed(AWAY)
    assert_allclose(np.sqrt(np.mean(white.residual(AWAY) ** 2)), 1.0)
    assert asked.noise_moves
