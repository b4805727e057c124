"""How fast are scipy's general solvers of stiff equations, given all the help they can take?

The ramp is handed over as a formula (no interpolation of samples), the diagonal Jacobian exactly: as a matrix to BDF
and Radau, as bands of width zero to LSODA.
"""

from collections.abc import Callable

import numpy as np
from scipy.integrate import solve_ivp

from bench.cases import RATE, Case
from bench.spectrum import Array


def prepare(case: Case, method: str, tolerance: float = 1e-6) -> Callable[[], Array]:
    """`tolerance` is the relative one, and the absolute one of each modal stress in MPa."""
    ratio, weight = case.modes
    tau = case.tau_max[0] * ratio
    stiff, soft = weight * (case.unrelaxed_modulus * RATE), weight * case.hardening_modulus / tau
    decay = -1.0 / tau

    def rate(t: float, state: Array) -> Array:
        strain = RATE * t
        return stiff + decay * state + soft * (np.exp(2.0 * strain) - np.exp(-strain))

    if method == "LSODA":
        bands = decay[None, :]
        options = {"jac": lambda t, state: bands, "lband": 0, "uband": 0}
    else:
        options = {"jac": np.diag(decay)}
    start = np.zeros(len(weight))
    span = (case.time[0], case.time[-1])

    def call() -> Array:
        found = solve_ivp(rate, span, start, method, case.time, rtol=tolerance, atol=tolerance, **options)
        if not found.success:
            raise RuntimeError(f"{method} at {tolerance:.1e}: {found.message}")
        return found.y.sum(axis=0)

    return call


def prepare_bdf(case: Case, tolerance: float = 1e-6) -> Callable[[], Array]:
    return prepare(case, "BDF", tolerance)


def prepare_lsoda(case: Case, tolerance: float = 1e-6) -> Callable[[], Array]:
    return prepare(case, "LSODA", tolerance)


def prepare_radau(case: Case, tolerance: float = 1e-6) -> Callable[[], Array]:
    return prepare(case, "Radau", tolerance)
