"""How fast is SA2 as fifty first-order recursive filters, scipy.signal.lfilter?"""

from collections.abc import Callable

import numpy as np
from scipy.signal import lfilter

from bench.cases import Case
from bench.spectrum import Array


def prepare(case: Case) -> Callable[[], Array]:
    ratio, weight = case.modes
    strain, hardening = case.true_strain, case.hardening
    E_u, G = case.unrelaxed_modulus, case.hardening_modulus
    x = (case.time[1] - case.time[0]) / (case.tau_max[0] * ratio)

    def call() -> Array:
        decay = np.exp(-x)
        mean = -np.expm1(-x) / x * weight
        change = E_u * np.diff(strain) - G * np.diff(hardening)
        total = G * hardening
        for a, b in zip(decay.tolist(), mean.tolist(), strict=True):
            total[1:] += lfilter([b], [1.0, -a], change)
        return total

    return call
