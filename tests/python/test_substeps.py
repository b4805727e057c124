"""How many steps from sample to sample a scheme of order 2 needs."""

import numpy as np
import pytest

from probation.identify.substeps import few_instants, shared_steps
from probation.law.refinement import fewest_substeps


@pytest.mark.parametrize(
    ("error", "first", "needed"),
    [
        (0.9, 1, 1),
        (9.0, 1, 3),  # 9 / 3² = 1
        (9.1, 1, 4),
        (9.0, 5, 5),  # never fewer than the first
        (1e4, 1, 16),  # never more than the most
        (float("inf"), 1, 16),
    ],
)
def test_an_error_that_falls_with_the_square_of_the_steps_is_met_at_once(error, first, needed):
    tried = []

    def error_with(steps):
        tried.append(steps)
        return error / steps**2

    assert fewest_substeps(error_with, 1.0, first, 16) == needed
    assert len(tried) <= 2


def test_an_error_that_falls_more_slowly_is_followed_a_step_at_a_time():
    """1.05 / sqrt(n) <= 1 from n = 1.1 on: the order would have it at 2; 1.5 / sqrt(n) needs 3, one further step."""
    assert fewest_substeps(lambda steps: 1.05 / steps**0.5, 1.0, 1, 16) == 2
    assert fewest_substeps(lambda steps: 1.5 / steps**0.5, 1.0, 1, 16) == 3


def test_a_record_that_errs_more_takes_more_steps():
    """By (c^2 / n)^(1/5), before rounding: 9.3, 2.1, 0.7 and 0.6 steps of 80, 2, 0.1 and 0.1, where all need 9."""
    size, lengths = np.array([80.0, 2.0, 0.1, 0.1]), np.array([1000, 1000, 500, 2000])
    steps = few_instants(size, lengths, 1.0)
    np.testing.assert_array_equal(steps, [10, 3, 1, 1])
    assert np.linalg.norm(size / steps**2) <= 1.0
    assert lengths @ steps < 0.5 * lengths.sum() * 9


def test_records_that_are_alike_take_as_many_steps_as_all_together_would():
    steps = few_instants(np.full(4, 8.0), np.full(4, 300), 1.0)
    np.testing.assert_array_equal(steps, np.full(4, 4))  # 2 * 8 / 4² = 1


def test_a_record_that_no_steps_are_enough_for_does_not_take_the_others_with_it():
    """An error of 1.5 that stays, one of 3 / s^2 and one of nearly nothing: the second takes little more than alone."""
    errors = [lambda _: 1.5, lambda steps: 3.0 / steps**2, lambda steps: 1e-6 / steps**2]
    assert shared_steps(errors, [500, 500, 500], 1.0, 1, 16) == [16, 3, 1]


def test_an_error_that_is_small_enough_takes_no_steps_more():
    assert shared_steps([lambda steps: 0.5 / steps**2] * 3, [100, 200, 300], 1.0, 2, 16) == [2, 2, 2]
