"""The slow part of a record, against scipy's filter."""

import numpy as np
import pytest
from numpy.testing import assert_allclose
from scipy.signal import savgol_coeffs, savgol_filter

from probation.noise.moving_parabola import moving_parabola, parabola_weights


@pytest.mark.parametrize(("count", "window"), [(50, 5), (101, 9), (2000, 167), (7, 7)])
def test_it_is_the_filter_of_savitzky_and_golay_with_polynomial_ends(count, window):
    values = np.random.default_rng(count).standard_normal((count, 3))
    assert_allclose(moving_parabola(values, window), savgol_filter(values, window, 2, axis=0), atol=1e-12)
    assert_allclose(parabola_weights(window), savgol_coeffs(window, 2), atol=1e-12)


def test_a_parabola_passes_unchanged():
    time = np.linspace(0.0, 3.0, 60)
    curve = 2.0 - time + 0.5 * time**2
    assert_allclose(moving_parabola(curve, 11), curve, atol=1e-12)
