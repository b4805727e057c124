"""Law and effects are fitted together to the optimum that an independent search finds."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.optimize import least_squares

from campaigns import linear_problem as problem
from probation import Campaign, ConvergenceError, Record
from probation.diagnosis.explain import base_parameters
from probation.effects.cause import Cause
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.problem import Problem
from probation.inference.refit import refit

COUNT = 120
TIME = np.linspace(0.0, 100.0, COUNT)
STRAIN = TIME / 100.0


def saturating(strain, parameters):
    """Stress = plateau (1 - exp(-strain / scale))."""
    return parameters[0] * -np.expm1(-strain / parameters[1])


def law(**changes):
    given = {"starts": (50.0, 0.3), "lower": (0.0, 0.01), "upper": (1e4, 10.0)}
    return problem.bar(saturating, ("plateau_MPa", "scale"), **{**given, **changes})


def fading(low=-50.0, scale=10.0, log_scale=0.3):
    """Stress + a exp(-t / time), a and ln(time) with normal priors around 0 and ln 20."""
    return problem.effect(
        lambda view, values: values[0] * np.exp(-view.time / values[1]),
        problem.parameter("size", low, 50.0, scale),
        problem.parameter("time_s", 1.0, 300.0, log_scale, centre=20.0, log=True),
    )


def data(size, seed=0):
    noise = problem.SIGMA * np.random.default_rng(seed).standard_normal(COUNT)
    return saturating(STRAIN, (40.0, 0.2)) + size * np.exp(-TIME / 35.0) + noise


def scipys(stress, *, low=-50.0, scale=10.0, log_scale=0.3, held=None):
    """(plateau, scale, size, time) and chi^2 by scipy's trust region, the formulas written out once more."""

    def residual(x):
        plateau, width, size, log_time = x if held is None else (*x[:2], held, x[2])
        model = plateau * (1.0 - np.exp(-STRAIN / width)) + size * np.exp(-TIME / np.exp(log_time))
        fit = (model - stress) / problem.SIGMA
        return np.append(fit, [size / scale, (log_time - np.log(20.0)) / log_scale])

    start, size = [50.0, 0.3, 1.0, 3.0], [50.0, 0.3, 1.0, 1.0]
    ends = ([0.0, 0.01, low, 0.0], [1e4, 10.0, 50.0, np.log(300.0)])
    if held is not None:
        start, size = ([*each[:2], each[3]] for each in (start, size))
        ends = tuple([*each[:2], each[3]] for each in ends)
    settled = {"xtol": 1e-14, "ftol": 1e-14, "gtol": 1e-14}
    found = least_squares(residual, start, bounds=ends, x_scale=size, **settled)
    x = found.x if held is None else np.array([*found.x[:2], held, found.x[2]])
    return np.array([*x[:3], np.exp(x[3])]), float(np.sum(found.fun[:-2] ** 2)), float(np.sum(found.fun**2))


def refitted(stress, effect, start=(50.0, 0.3, 1.0, 20.0), base=None, **options):
    return problem.solved(base or law(), problem.views([stress]), [Cause(effect, effect.forms[0])], start, **options)


@pytest.mark.parametrize("size", [0.0, 4.0, -12.0])
def test_the_optimum_with_priors_is_scipys(size):
    expected, chi_square, _ = scipys(data(size))
    found = refitted(data(size), fading())
    assert_allclose(found.parameters, expected, rtol=2e-4, atol=1e-4)
    assert found.chi_square == pytest.approx(chi_square, abs=1e-4)
    assert not np.any(found.at_bound)


def test_a_quick_search_ends_within_a_tenth_of_the_optimum():
    """Of the objective: far less than noise does to it."""
    _, _, objective = scipys(data(4.0))
    found = refitted(data(4.0), fading(), most_steps=15, settled=0.02)
    penalty = found.coordinates.prior.penalty(found.coordinates.of(found.parameters))
    assert objective <= found.chi_square + penalty + 1e-9 < objective + 0.1


def test_a_search_goes_on_where_another_one_ended_with_the_derivatives_that_it_had(monkeypatch):
    """Of the same problem; with another noise they are asked for again."""
    begun = refitted(data(4.0), fading(), most_steps=2)
    asked, real = [], Problem.residual_and_jacobian
    monkeypatch.setattr(Problem, "residual_and_jacobian", lambda *given: asked.append(given) or real(*given))
    assert refit(begun.problem, begun, most_steps=0).chi_square == begun.chi_square
    assert not asked
    refit(begun.problem.with_noises(begun.problem.whitener.noises), begun, most_steps=0)
    assert len(asked) == 1
    further = refit(begun.problem, begun, settled=0.0, most_steps=100)
    assert_allclose(further.parameters, refitted(data(4.0), fading()).parameters, rtol=1e-3)


def test_an_amplitude_that_wants_below_its_bound_stays_there_and_the_others_settle_beside_it():
    expected, chi_square, _ = scipys(data(-12.0), low=0.0)
    found = refitted(data(-12.0), fading(low=0.0))
    assert expected[2] == pytest.approx(0.0, abs=1e-6)
    assert found.parameters[2] == 0.0
    assert list(found.at_bound[0]) == [False, False, True, False]
    assert_allclose(found.parameters[:2], expected[:2], rtol=1e-4)
    assert found.chi_square == pytest.approx(chi_square, abs=1e-4)


def test_an_amplitude_leaves_its_bound_if_the_data_want_it():
    expected, _, _ = scipys(data(6.0), low=0.0)
    found = refitted(data(6.0), fading(low=0.0), start=(50.0, 0.3, 0.0, 20.0))
    assert_allclose(found.parameters, expected, rtol=2e-4)


def test_a_prior_shrinks_a_linear_amplitude_as_ridge_regression_does():
    """(J^T J + 1/s^2)^-1 J^T y, the modulus without a prior."""
    stress = 100.0 * STRAIN + 2.0 + problem.SIGMA * np.random.default_rng(3).standard_normal(COUNT)
    constant = problem.effect(
        lambda view, values: np.full(len(view), values[0]), problem.parameter("size", -50, 50, 0.1)
    )
    found = problem.solved(problem.bar(), problem.views([stress]), [Cause(constant, constant.forms[0])])
    design = np.column_stack([STRAIN, np.ones(COUNT)]) / problem.SIGMA
    expected = np.linalg.solve(design.T @ design + np.diag([0.0, 100.0]), design.T @ (stress / problem.SIGMA))
    assert_allclose(found.parameters, expected, rtol=1e-6)
    assert expected[1] < 1.5


def test_a_held_parameter_stays_and_the_others_find_the_optimum_beside_it():
    expected, _, _ = scipys(data(4.0), held=2.0)
    found = refitted(data(4.0), fading(), start=(50.0, 0.3, 2.0, 20.0), held=np.array([False, False, True, False]))
    assert found.parameters[2] == 2.0
    assert_allclose(found.parameters, expected, rtol=2e-4)


def test_a_start_outside_the_bounds_begins_at_the_nearest_one_within():
    expected, _, _ = scipys(data(4.0))
    found = refitted(data(4.0), fading(), start=(50.0, 0.001, 90.0, 900.0))
    assert_allclose(found.parameters, expected, rtol=2e-4)


def brittle(limit, tried=None):
    """The same law, which cannot be solved beyond a plateau."""

    def stress(strain, parameters):
        if tried is not None:
            tried.append(parameters[0])
        if parameters[0] > limit:
            raise ConvergenceError("no solution")
        return saturating(strain, parameters)

    return problem.bar(stress, ("plateau_MPa", "scale"), (20.0, 0.3), (0.0, 0.01), (1e4, 10.0))


def test_a_search_turns_back_where_the_law_cannot_be_solved():
    """From a scale of 8 the search would pass a plateau of 200 on its way to 40."""
    expected, _, _ = scipys(data(-12.0))
    tried = []
    found = refitted(data(-12.0), fading(), start=(5.0, 8.0, 0.0, 20.0), base=brittle(100.0, tried))
    assert max(tried) > 100.0
    assert_allclose(found.parameters, expected, rtol=2e-4)


def test_a_law_without_a_solution_at_the_start_is_an_error():
    with pytest.raises(ConvergenceError):
        refitted(data(4.0), fading(), start=(70.0, 0.3, 0.0, 20.0), base=brittle(60.0))


def test_the_jacobian_is_the_derivative_of_the_whitened_residual_along_the_coordinates():
    """Central differences by the coordinates: a parameter over its size, a logarithm."""
    found = refitted(data(4.0), fading())
    at, step = found.coordinates.of(found.parameters), 1e-5
    known = problem.whitener(found.model.views)
    for index in range(4):
        up, down = at.copy(), at.copy()
        up[index] += step
        down[index] -= step
        moved = [known.residual(found.model.residual(found.coordinates.parameters(x))) for x in (up, down)]
        assert_allclose(found.jacobian[:, index], (moved[0] - moved[1]) / (2.0 * step), rtol=1e-3, atol=1e-3)


def test_a_base_parameter_at_its_bound_has_no_error():
    """A stress that falls with the strain: the best G is negative, which is not possible."""
    time = np.linspace(0.0, 1.0, 60)
    stress = 30.0 - 20.0 * time + 0.01 * np.random.default_rng(1).normal(size=60)
    record = Record("a", time, time, stress, control="strain-rate")
    campaign = Campaign("x", (record,))
    hardening = base_parameters(base_fit(campaign, plain_fit(campaign)))[2]
    assert (hardening.value, hardening.se, hardening.status) == (0.0, None, "not_identifiable")
