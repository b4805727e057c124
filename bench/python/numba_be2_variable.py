"""How fast is bE2 in numba where the steps are uneven or tau_max varies (no coefficient can be hoisted)?"""

from collections.abc import Callable

import numba
import numpy as np

from bench.cases import Case
from bench.spectrum import Array


@numba.njit(fastmath=True)
def stress(
    time: Array, rate: Array, hardening: Array, E_u: float, G: float, tau_max: Array, ratio: Array, weight: Array
) -> Array:
    n, modes = len(hardening), len(weight)
    total = np.empty(n)
    here = weight * (G * hardening[0])
    before = here.copy()
    total[0] = here.sum()
    for i in range(1, n):
        h = time[i] - time[i - 1]
        a0, a1, a2 = 1.0, -1.0, 0.0  # backward Euler
        if i > 1:  # BDF2 on an uneven grid, w = h / h0
            w = h / (time[i - 1] - time[i - 2])
            a0, a1, a2 = (1.0 + 2.0 * w) / (1.0 + w), -(1.0 + w), w * w / (1.0 + w)
        tau = tau_max[min(i, len(tau_max) - 1)]
        e = 0.0
        for j in range(modes):
            x = h / (tau * ratio[j])
            source = weight[j] * (E_u * rate[i] * h + G * hardening[i] * x)
            new = (source - a1 * here[j] - a2 * before[j]) / (a0 + x)
            before[j] = here[j]
            here[j] = new
            e += new
        total[i] = e
    return total


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    hardening, E_u, G = case.hardening, case.unrelaxed_modulus, case.hardening_modulus
    return lambda: stress(case.time, case.strain_rate, hardening, E_u, G, case.tau_max, ratio, weight)
