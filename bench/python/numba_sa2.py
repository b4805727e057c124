"""How fast is SA2 (exponential recursion, strain and e_HT straight) in numba, coefficients hoisted, fastmath?"""

from collections.abc import Callable

import numba
import numpy as np

from bench.cases import Case
from bench.spectrum import Array


@numba.njit(fastmath=True)
def stress(
    h: float, strain: Array, hardening: Array, E_u: float, G: float, relaxation_time: Array, weight: Array
) -> Array:
    n, modes = len(strain), len(weight)
    total = np.empty(n)
    total[0] = G * hardening[0]
    state = np.zeros(modes)  # sigma_j - p_j G e_HT
    x = h / relaxation_time
    decay = np.exp(-x)
    mean = -np.expm1(-x) / x * weight
    for i in range(1, n):
        change = E_u * (strain[i] - strain[i - 1]) - G * (hardening[i] - hardening[i - 1])
        e = 0.0
        for j in range(modes):
            state[j] = decay[j] * state[j] + mean[j] * change
            e += state[j]
        total[i] = e + G * hardening[i]
    return total


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    h, hardening = case.time[1] - case.time[0], case.hardening
    tau = case.tau_max[0] * ratio
    return lambda: stress(h, case.true_strain, hardening, case.unrelaxed_modulus, case.hardening_modulus, tau, weight)
