"""The search over one variable and the moduli that may not be negative, against scipy's."""

import numpy as np
import pytest
from scipy.optimize import minimize_scalar, nnls

from probation.inference.scalar_minimum import non_negative, scalar_minimum

FUNCTIONS = {
    "parabola": (lambda x: (x - 0.3) ** 2, -1.0, 2.0),
    "kink": (lambda x: abs(x - 0.7) + 0.1 * x, -1.0, 2.0),
    "wave": (lambda x: np.sin(3.0 * x) + 0.1 * x * x, -2.0, 3.0),
    "at the lower end": (np.exp, -3.0, 1.0),
    "at the upper end": (lambda x: -np.exp(x), -3.0, 1.0),
    "flat": (lambda x: 0.0 * x, 1.0, 2.0),
}


@pytest.mark.parametrize("name", FUNCTIONS)
def test_it_ends_where_scipy_ends(name):
    function, low, high = FUNCTIONS[name]
    found = scalar_minimum(function, low, high, 1e-9)
    expected = minimize_scalar(function, bounds=(low, high), method="bounded", options={"xatol": 1e-9}).x
    assert found == pytest.approx(expected, abs=2e-8)


@pytest.mark.parametrize("seed", range(20))
def test_coefficients_are_those_of_non_negative_least_squares(seed):
    rng = np.random.default_rng(seed)
    columns, target = rng.standard_normal((12, 1 + seed % 3)), rng.standard_normal(12)
    assert non_negative(columns, target) == pytest.approx(nnls(columns, target)[0], abs=1e-9)
