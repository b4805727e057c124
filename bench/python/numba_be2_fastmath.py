"""How fast does numba get with the coefficients hoisted and fastmath, which lets it use vector instructions?"""

from collections.abc import Callable

import numba

from bench.cases import Case
from bench.python.numba_be2_hoisted import hoisted
from bench.spectrum import Array

stress = numba.njit(fastmath=True)(hoisted)


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    h, hardening = case.time[1] - case.time[0], case.hardening
    tau = case.tau_max[0] * ratio
    return lambda: stress(h, case.strain_rate, hardening, case.unrelaxed_modulus, case.hardening_modulus, tau, weight)
