"""How many steps from sample to sample a scheme of order 2 needs."""

import pytest

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
