"""How many steps from sample to sample a scheme of order 2 needs."""

import numpy as np
import pytest

from probation.identify.substeps import fewest_instants
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


def test_records_share_an_error_with_as_few_instants_as_can_be():
    """One record errs by 80 where another errs by 2 and two hardly do: all with 9 steps, or 10, 3, 1 and 1."""
    size, lengths = np.array([80.0, 2.0, 0.1, 0.1]), np.array([1000, 1000, 500, 2000])
    steps = fewest_instants(size, lengths, 1.0)
    assert np.linalg.norm(size / steps**2) <= 1.0
    np.testing.assert_array_equal(steps, [10, 3, 1, 1])
    assert np.linalg.norm(size / 9.0**2) <= 1.0
    assert lengths @ steps < 0.5 * lengths.sum() * 9
    for record in range(2):  # with one step less somewhere it is missed, or nearly so
        fewer = steps - (np.arange(4) == record)
        assert np.linalg.norm(size / fewer**2) > 0.95


def test_records_that_are_alike_take_as_many_steps_as_all_together_would():
    steps = fewest_instants(np.full(4, 8.0), np.full(4, 300), 1.0)
    np.testing.assert_array_equal(steps, np.full(4, 4))  # 2 * 8 / 4² = 1
