"""The optimiser by itself, on problems whose answers are known without it."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation import ConvergenceError, InputError
from probation.inference.least_squares import Bounds, NormalPrior, minimise


class Objective:
    """Residuals and derivatives from two functions; remembers where it was asked."""

    def __init__(self, residual, jacobian):
        self.values, self.slopes, self.asked = residual, jacobian, []

    def residual(self, x):
        self.asked.append(x.copy())
        return self.values(x)

    def tangent(self, x):
        return self.values(x), self.slopes(x)


def line(seed=0, count=40):
    """A straight line with noise: design matrix and data."""
    random = np.random.default_rng(seed)
    design = np.column_stack([np.ones(count), np.linspace(0.0, 1.0, count)])
    return design, design @ [2.0, -3.0] + 0.1 * random.normal(size=count)


def linear(design, data):
    return Objective(lambda x: design @ x - data, lambda x: design)


def rosenbrock():
    """(1 - x)^2 + 100 (y - x^2)^2, least in a curved valley at (1, 1)."""
    return Objective(
        lambda x: np.array([1.0 - x[0], 10.0 * (x[1] - x[0] ** 2)]),
        lambda x: np.array([[-1.0, 0.0], [-20.0 * x[0], 10.0]]),
    )


def decay(time, data):
    return Objective(
        lambda x: x[0] * np.exp(-x[1] * time) - data,
        lambda x: np.column_stack([np.exp(-x[1] * time), -x[0] * time * np.exp(-x[1] * time)]),
    )


def test_a_linear_problem_is_solved_in_one_step():
    """By the normal equations, (X^T X)^-1 X^T y; a second step has nothing to gain."""
    design, data = line()
    found = minimise(linear(design, data), np.zeros(2), tolerance=1e-6)
    assert_allclose(found.x, np.linalg.solve(design.T @ design, design.T @ data), rtol=1e-12)
    assert found.steps == 1
    assert found.cost == pytest.approx(np.sum((design @ found.x - data) ** 2))


def test_a_curved_valley_is_followed_to_its_end():
    found = minimise(rosenbrock(), np.array([-1.2, 1.0]), tolerance=1e-6)
    assert_allclose(found.x, [1.0, 1.0], rtol=1e-10)


def test_coordinates_of_any_size_are_found_alike():
    """The damping follows the normal matrix's diagonal: units of 1e-9 and 1e9 change nothing."""
    units = np.array([1e-9, 1e9])
    inner = rosenbrock()
    scaled = Objective(lambda x: inner.values(x * units), lambda x: inner.slopes(x * units) * units)
    plain, found = minimise(rosenbrock(), np.array([-1.2, 1.0])), minimise(scaled, np.array([-1.2, 1.0]) / units)
    assert_allclose(found.x * units, [1.0, 1.0], rtol=1e-9)
    assert abs(found.steps - plain.steps) <= 1


def test_nonlinear_noisy_data_end_where_the_gradient_is_zero():
    """Amplitude and rate of a decay: J^T r = 0 to within 1e-6 standard errors."""
    time = np.linspace(0.0, 3.0, 60)
    data = 5.0 * np.exp(-1.3 * time) + 0.05 * np.random.default_rng(1).normal(size=60)
    found = minimise(decay(time, data), np.array([1.0, 0.2]), tolerance=1e-6)
    covariance = np.linalg.inv(found.jacobian.T @ found.jacobian)
    left = covariance @ found.jacobian.T @ found.residual
    assert np.all(np.abs(left) < 1e-5 * np.sqrt(np.diag(covariance)) * 0.05)
    assert_allclose(found.x, [5.0, 1.3], atol=0.1)


def test_a_coordinate_that_wants_out_stays_at_its_bound_and_the_rest_is_best_jointly_it():
    """The slope is -3; held at 0, the best constant is the mean."""
    design, data = line()
    bounds = Bounds(np.array([-np.inf, 0.0]), np.array([np.inf, np.inf]))
    found = minimise(linear(design, data), np.array([0.0, 1.0]), bounds=bounds, tolerance=1e-9)
    assert found.x[1] == 0.0
    assert found.x[0] == pytest.approx(data.mean(), rel=1e-9)
    assert [list(side) for side in bounds.reached(found.x)] == [[False, True], [False, False]]


def test_a_coordinate_leaves_its_bound_where_the_data_want_it():
    design, data = line()
    bounds = Bounds(np.array([0.0, -10.0]), np.array([10.0, 10.0]))
    found = minimise(linear(design, data), np.array([0.0, 10.0]), bounds=bounds, tolerance=1e-9)
    assert_allclose(found.x, np.linalg.lstsq(design, data, rcond=None)[0], rtol=1e-9)


def test_a_held_coordinate_stays():
    design, data = line()
    found = minimise(linear(design, data), np.array([0.0, 1.0]), held=np.array([False, True]), tolerance=1e-9)
    assert found.x[1] == 1.0
    assert found.x[0] == pytest.approx(np.mean(data - design[:, 1]), rel=1e-9)


def test_a_normal_prior_is_ridge_regression():
    """(X^T X + P)^-1 (X^T y + P c)."""
    design, data = line()
    prior = NormalPrior(np.array([1.0, 4.0]), np.array([0.0, 30.0]))
    found = minimise(linear(design, data), np.zeros(2), prior=prior, tolerance=1e-9)
    weight = np.diag(prior.precision)
    expected = np.linalg.solve(design.T @ design + weight, design.T @ data + weight @ prior.centre)
    assert_allclose(found.x, expected, rtol=1e-9)
    assert found.cost == pytest.approx(np.sum((design @ expected - data) ** 2) + 30.0 * (expected[1] - 4.0) ** 2)


@pytest.mark.parametrize("error", [InputError, ConvergenceError, FloatingPointError, None])
def test_where_there_is_no_answer_the_search_turns_back(error):
    """log x with a first step from 4 to below 0: refused, or not a number."""

    def residual(x):
        if x[0] <= 0.0:
            if error is not None:
                raise error("nothing here")
            return np.array([np.nan])
        return np.log(x)

    objective = Objective(residual, lambda x: np.array([[1.0 / x[0]]]))
    found = minimise(objective, np.array([4.0]))
    assert found.x[0] == pytest.approx(1.0, rel=1e-9)
    assert min(x[0] for x in objective.asked) <= 0.0


def test_a_start_without_an_answer_is_refused():
    with pytest.raises(ConvergenceError, match="not finite at the start"):
        minimise(Objective(lambda x: np.array([np.inf]), lambda x: np.ones((1, 1))), np.zeros(1))


def test_a_decrease_that_is_not_worth_it_ends_the_search():
    """From a distance of 1e-3 in the valley the objective falls by less than 1e-3."""
    start = np.array([1.001, 1.002])
    assert minimise(rosenbrock(), start, settled=1e-3).steps == 0
    assert minimise(rosenbrock(), start, settled=1e-12).steps > 0


def test_no_step_is_longer_than_asked():
    objective = rosenbrock()
    minimise(objective, np.array([-1.2, 1.0]), longest_step=0.25)
    path = np.array([[-1.2, 1.0], objective.asked[0]])
    assert np.abs(np.diff(path, axis=0)).max() <= 0.25 + 1e-12
    assert_allclose(minimise(objective, np.array([-1.2, 1.0]), longest_step=0.25).x, [1.0, 1.0], rtol=1e-9)


def test_steps_are_counted_and_limited():
    found = minimise(rosenbrock(), np.array([-1.2, 1.0]), most_steps=3)
    assert found.steps == 3
    assert found.cost < 24.2  # of the start


def test_an_exact_fit_ends_without_tolerance():
    """Nothing is left: the search ends by the length of its step."""
    time = np.linspace(0.0, 3.0, 20)
    objective = decay(time, 5.0 * np.exp(-1.3 * time))
    found = minimise(objective, np.array([4.0, 1.0]))
    assert_allclose(found.x, [5.0, 1.3], rtol=1e-12)
    assert len(objective.asked) < 30


def test_a_direction_that_the_data_do_not_determine_does_no_harm():
    """x + y is known, x - y is not: the shortest step, from where it began."""
    objective = Objective(lambda x: np.array([x[0] + x[1] - 4.0]), lambda x: np.ones((1, 2)))
    assert_allclose(minimise(objective, np.array([1.0, 0.0])).x, [2.5, 1.5], rtol=1e-9)


def test_a_direction_that_is_not_determined_does_no_harm_behind_steps_that_fail():
    """arctan(x + y)^3 from far off: steps that are too long leave a damping that vanishes to rounding, and x = y."""

    def slopes(x):
        total = x.sum()
        return np.full((1, 2), 3.0 * np.arctan(total) ** 2 / (1.0 + total**2))

    objective = Objective(lambda x: np.array([np.arctan(x.sum()) ** 3]), slopes)
    found = minimise(objective, np.array([2.5, 2.5]))
    assert found.cost < 1e-20
    assert_allclose(found.x[0], found.x[1], atol=1e-4)


def test_the_last_step_ends_where_there_is_a_derivative_unless_none_is_asked_for():
    def slopes(x):
        if x[0] > 2.0:
            raise ArithmeticError
        return np.ones((1, 1))

    objective = Objective(lambda x: x - 3.0, slopes)
    found = minimise(objective, np.array([0.0]), most_steps=1)
    assert 0.0 < found.x[0] <= 2.0
    assert found.jacobian.tolist() == [[1.0]]
    assert minimise(objective, np.array([0.0]), most_steps=1, tangent_at_end=False).x.tolist() == [3.0]
