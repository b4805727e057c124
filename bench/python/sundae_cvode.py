"""How fast is CVODE from Python, through scikit-sundae, with a Python function for eq. (6)?

The ramp is handed over as a formula; the diagonal Jacobian is exact, banded with width zero.
"""

from collections.abc import Callable

import numpy as np
from sksundae.cvode import CVODE

from bench.cases import RATE, Case
from bench.spectrum import Array


def prepare(case: Case, tolerance: float = 1e-6) -> Callable[[], Array]:
    """`tolerance` is the relative one, and the absolute one of each modal stress in MPa."""
    ratio, weight = case.modes
    tau = case.tau_max[0] * ratio
    stiff, soft = weight * (case.unrelaxed_modulus * RATE), weight * case.hardening_modulus / tau
    decay = -1.0 / tau
    matrix = np.diag(decay)
    start = np.zeros(len(weight))

    def rate(t: float, state: Array, out: Array) -> None:
        strain = RATE * t
        out[:] = stiff + decay * state + soft * (np.exp(2.0 * strain) - np.exp(-strain))

    def jacobian(t: float, state: Array, rates: Array, out: Array) -> None:
        out[:] = matrix

    def call() -> Array:
        solver = CVODE(
            rate, rtol=tolerance, atol=tolerance, linsolver="band", lband=0, uband=0, jacfn=jacobian,
            max_num_steps=100_000,
        )  # fmt: skip
        found = solver.solve(case.time, start)
        if not found.success:
            raise RuntimeError(f"CVODE at {tolerance:.1e}: {found.message}")
        return found.y.sum(axis=1)

    return call
