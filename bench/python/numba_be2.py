"""How fast is eq. (9), copied from the paper into numba?"""

from collections.abc import Callable

import numba
import numpy as np

from bench.cases import Case
from bench.spectrum import Array


@numba.njit
def stress(
    h: float, rate: Array, hardening: Array, E_u: float, G: float, relaxation_time: Array, weight: Array
) -> Array:
    n, modes = len(hardening), len(weight)
    here, before = np.empty(modes), np.empty(modes)
    total = np.zeros(n)
    for j in range(modes):
        here[j] = weight[j] * G * hardening[0]
        total[0] += here[j]
    for i in range(1, n):
        for j in range(modes):
            tau, p = relaxation_time[j], weight[j]
            source = p * E_u * rate[i] + p * G * hardening[i] / tau
            if i == 1:  # backward Euler
                new = (here[j] + h * source) / (1.0 + h / tau)
            else:  # eq. (9), solved for sigma_j^{n+1}
                new = (4.0 / 3.0 * here[j] - before[j] / 3.0 + 2.0 * h / 3.0 * source) / (1.0 + 2.0 * h / (3.0 * tau))
            before[j] = here[j]
            here[j] = new
            total[i] += new
    return total


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    h, hardening = case.time[1] - case.time[0], case.hardening
    tau = case.tau_max[0] * ratio
    return lambda: stress(h, case.strain_rate, hardening, case.unrelaxed_modulus, case.hardening_modulus, tau, weight)
