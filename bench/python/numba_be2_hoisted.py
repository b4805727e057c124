"""How fast is eq. (9) in numba once its coefficients are taken out of the time loop?"""

from collections.abc import Callable

import numba
import numpy as np

from bench.cases import Case
from bench.spectrum import Array


def hoisted(
    h: float, rate: Array, hardening: Array, E_u: float, G: float, relaxation_time: Array, weight: Array
) -> Array:
    n, modes = len(hardening), len(weight)
    total = np.empty(n)
    here = weight * (G * hardening[0])
    total[0] = here.sum()
    # The first step is backward Euler, every other eq. (9).
    bottom = 1.0 / (1.0 + h / relaxation_time)
    before = here.copy()
    here = (before + h * weight * (E_u * rate[1] + G * hardening[1] / relaxation_time)) * bottom
    total[1] = here.sum()
    bottom = 1.0 / (1.0 + 2.0 * h / (3.0 * relaxation_time))
    a, b = 4.0 / 3.0 * bottom, -1.0 / 3.0 * bottom
    c, d = 2.0 * h / 3.0 * weight * E_u * bottom, 2.0 * h / 3.0 * weight * G / relaxation_time * bottom
    for i in range(2, n):
        e, s, g = 0.0, rate[i], hardening[i]
        for j in range(modes):
            new = a[j] * here[j] + b[j] * before[j] + c[j] * s + d[j] * g
            before[j] = here[j]
            here[j] = new
            e += new
        total[i] = e
    return total


stress = numba.njit(hoisted)


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    h, hardening = case.time[1] - case.time[0], case.hardening
    tau = case.tau_max[0] * ratio
    return lambda: stress(h, case.strain_rate, hardening, case.unrelaxed_modulus, case.hardening_modulus, tau, weight)
