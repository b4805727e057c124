"""How fast is SA2 in numba where the steps are uneven or tau_max varies (two exponentials per mode and step)?"""

from collections.abc import Callable

import numba
import numpy as np

from bench.cases import Case
from bench.spectrum import Array


@numba.njit(fastmath=True)
def stress(
    time: Array, strain: Array, hardening: Array, E_u: float, G: float, tau_max: Array, ratio: Array, weight: Array
) -> Array:
    n, modes = len(strain), len(weight)
    total = np.empty(n)
    total[0] = G * hardening[0]
    state = np.zeros(modes)
    for i in range(1, n):
        change = E_u * (strain[i] - strain[i - 1]) - G * (hardening[i] - hardening[i - 1])
        last = len(tau_max) - 1
        # Reduced time by the trapezoid of 1 / tau_max.
        scale = (time[i] - time[i - 1]) * 0.5 * (1.0 / tau_max[min(i, last)] + 1.0 / tau_max[min(i - 1, last)])
        e = 0.0
        for j in range(modes):
            x = scale / ratio[j]
            loss = -np.expm1(-x)
            state[j] = state[j] - loss * state[j] + weight[j] * loss / x * change
            e += state[j]
        total[i] = e + G * hardening[i]
    return total


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    hardening, E_u, G = case.hardening, case.unrelaxed_modulus, case.hardening_modulus
    return lambda: stress(case.time, case.true_strain, hardening, E_u, G, case.tau_max, ratio, weight)
