"""How fast is eq. (9) in numpy, arrays over the modes and a Python loop over time?"""

from collections.abc import Callable

import numpy as np

from bench.cases import Case
from bench.spectrum import Array


def naive(
    h: float, rate: Array, hardening: Array, E_u: float, G: float, relaxation_time: Array, weight: Array
) -> Array:
    """Eqs. (8), (9) as printed, solved for sigma_j^{n+1}."""
    total = np.empty(len(hardening))
    here = weight * G * hardening[0]
    before = here
    total[0] = here.sum()
    for i in range(1, len(hardening)):
        source = weight * E_u * rate[i] + weight * G * hardening[i] / relaxation_time
        if i == 1:
            new = (here + h * source) / (1.0 + h / relaxation_time)
        else:
            new = (4.0 / 3.0 * here - 1.0 / 3.0 * before + 2.0 * h / 3.0 * source) / (
                1.0 + 2.0 * h / (3.0 * relaxation_time)
            )
        before, here = here, new
        total[i] = here.sum()
    return total


def precomputed(
    h: float, rate: Array, hardening: Array, E_u: float, G: float, relaxation_time: Array, weight: Array
) -> Array:
    """The same with coefficients and forcing tabulated before the loop, and all sums after it."""
    modal = np.empty((len(hardening), len(weight)))
    modal[0] = weight * (G * hardening[0])
    bottom = 1.0 / (1.0 + h / relaxation_time)
    modal[1] = (modal[0] + h * weight * (E_u * rate[1] + G * hardening[1] / relaxation_time)) * bottom
    bottom = 1.0 / (1.0 + 2.0 * h / (3.0 * relaxation_time))
    a, b = 4.0 / 3.0 * bottom, -1.0 / 3.0 * bottom
    forcing = np.multiply.outer(rate, 2.0 * h / 3.0 * E_u * weight * bottom)
    forcing += np.multiply.outer(hardening, 2.0 * h / 3.0 * G * weight / relaxation_time * bottom)
    older = np.empty(len(weight))
    for i in range(2, len(hardening)):
        new = np.multiply(a, modal[i - 1], out=modal[i])
        new += np.multiply(b, modal[i - 2], out=older)
        new += forcing[i]
    return modal.sum(axis=1)


def prepare(case: Case, stress: Callable[..., Array]) -> Callable[[], Array]:
    ratio, weight = case.modes
    h, hardening = case.time[1] - case.time[0], case.hardening
    tau = case.tau_max[0] * ratio
    return lambda: stress(h, case.strain_rate, hardening, case.unrelaxed_modulus, case.hardening_modulus, tau, weight)


def prepare_naive(case: Case) -> Callable[[], Array]:
    return prepare(case, naive)


def prepare_precomputed(case: Case) -> Callable[[], Array]:
    return prepare(case, precomputed)
