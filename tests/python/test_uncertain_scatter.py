"""What is not known of the specimens' scatter is part of the null distribution of the test for a gap."""

import numpy as np
import pytest
from numpy.testing import assert_allclose

from probation.noise.uncertain_scatter import UncertainScatter

COUNT = 8
RNG = np.random.default_rng(5)
DONE = RNG.normal(size=(COUNT, 2))
"""What a specimen's two deviations, of the estimated size, do to a record whose other noise is white."""


def root_of_noise(deviations):
    """The root of the covariance I + F diag(s^2) F^T of a record, and the same whitened with s = 1."""
    lower = np.linalg.cholesky(np.eye(COUNT) + DONE @ DONE.T)
    covariance = np.eye(COUNT) + DONE @ np.diag(np.square(deviations)) @ DONE.T
    return np.linalg.solve(lower, np.linalg.solve(lower, covariance).T), np.linalg.solve(lower, DONE)


@pytest.mark.parametrize("ratios", [(1.0, 1.0), (0.3, 2.0), (3.0, 0.5)])
def test_noise_of_another_scatter_has_the_covariance_of_that_scatter_whitened_with_the_estimate(ratios):
    """L (I + F s^2 F^T) L^T with L L^T = I + F F^T, against 200 000 draws."""
    expected, columns = root_of_noise(ratios)
    drawn = UncertainScatter((columns,), np.array([ratios])).spread(
        RNG.standard_normal((200_000, COUNT)), RNG, lambda values: values
    )
    assert_allclose(np.cov(drawn.T), expected, atol=0.02 * max(ratios) ** 2)


def test_a_scatter_that_is_known_exactly_changes_no_draw():
    noise = RNG.standard_normal((50, COUNT))
    _, columns = root_of_noise((1.0, 1.0))
    known = UncertainScatter((columns,), np.ones((7, 2)))
    assert_allclose(known.spread(noise, RNG, lambda values: values), noise, atol=1e-12)


def test_an_open_scatter_reaches_further_than_its_own_mean_square():
    """Ratios of 0.2 and 1.4 have a mean square of 1; every third deviation beyond 2 is then one beyond 2.8 sigma."""
    _, columns = root_of_noise((1.0, 1.0))
    direction = columns[:, 0] / np.linalg.norm(columns[:, 0])
    drawn = UncertainScatter((columns,), np.array([[0.2, 0.2], [1.4, 1.4]])).spread(
        RNG.standard_normal((100_000, COUNT)), RNG, lambda values: values
    )
    along = drawn @ direction
    assert np.mean(np.abs(along) > 3.3) > 2.0 * 0.00097
