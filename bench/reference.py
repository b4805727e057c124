"""What is the stress, to far more digits than any scheme under test? Written apart from the engine."""

from collections.abc import Callable
from itertools import pairwise

import numpy as np

from bench.spectrum import Array, hardening_strain, modes


def ramp(time: Array, rate: float, unrelaxed_modulus: float, tau_max: float, hardening_modulus: float) -> Array:
    """Closed form for true_strain = rate * time, eq. (7), in the form that is stable at every limit."""
    ratio, weight = modes()
    tau = tau_max * ratio
    t = time[:, None]
    viscous = unrelaxed_modulus * rate * tau * -np.expm1(-t / tau)
    hardening = hardening_modulus / tau * t * (_divided(2 * rate * t, -t / tau) - _divided(-rate * t, -t / tau))
    return (viscous + hardening) @ weight


def _divided(x: Array, y: Array) -> Array:
    """(e^x - e^y) / (x - y), and e^x where they meet."""
    gap = np.abs(x - y)
    safe = np.where(gap == 0.0, 1.0, gap)
    return np.exp(np.maximum(x, y)) * np.where(gap == 0.0, 1.0, -np.expm1(-safe) / safe)


def smooth(
    time: Array,
    strain_at: Callable[[Array], Array],
    tau_max_at: Callable[[Array], Array],
    unrelaxed_modulus: float,
    hardening_modulus: float,
    substeps: int = 16,
) -> Array:
    """Any history, tau_max varying: an exponential recursion of order 4 or better, `substeps` to every interval.

    Within a substep everything is a parabola through its two ends and its middle, in reduced time. The first
    intervals are divided more finely towards zero, where eq. (A-1) is not smooth.
    """
    ratio, weight = modes()
    fractions = np.linspace(0.0, 1.0, substeps + 1)[1:]
    fine = [time[:1], time[1] * np.geomspace(1e-8, 1.0, 40 * substeps)]
    fine += [begin + (end - begin) * fractions for begin, end in pairwise(time[1:])]
    ends = np.concatenate(fine)
    begin, end = ends[:-1], ends[1:]
    middle = 0.5 * (begin + end)

    def integrated(t: Array) -> Array:  # of the forcing, per unit weight: E_u e - G e_HT
        strain = strain_at(t)
        return unrelaxed_modulus * strain - hardening_modulus * hardening_strain(strain)

    fluidity = [1.0 / tau_max_at(t) for t in (begin, middle, end)]
    h = end - begin
    whole = h / 6.0 * (fluidity[0] + 4.0 * fluidity[1] + fluidity[2])
    half = h / 24.0 * (5.0 * fluidity[0] + 8.0 * fluidity[1] - fluidity[2])
    forcing = [integrated(t) for t in (begin, middle, end)]
    # F as a parabola of u = xi / whole through 0, a, 1: F = F0 + p u + q u^2.
    a = half / whole
    rise, half_rise = forcing[2] - forcing[0], forcing[1] - forcing[0]
    q = (half_rise - a * rise) / (a * a - a)
    p = rise - q

    state = np.zeros_like(ratio)
    stress = np.empty(len(time))
    relaxed = hardening_modulus * hardening_strain(strain_at(time))
    stress[0] = relaxed[0]
    last = 40 * substeps + substeps * np.arange(len(time) - 1)  # index in `ends` of each sample but the first
    upcoming = 0
    for n in range(len(h)):
        x = whole[n] / ratio
        decay = np.exp(-x)
        mean = np.where(x < 1e-3, 1 - x / 2 + x * x / 6 - x**3 / 24, -np.expm1(-x) / x)
        slope = np.where(x < 1e-2, 0.5 - x / 6 + x * x / 24 - x**3 / 120 + x**4 / 720, (1 - mean) / x)
        state = decay * state + p[n] * mean + 2.0 * q[n] * slope  # int e^{-x(1-u)} (p + 2 q u) du
        if n + 1 == last[upcoming]:
            upcoming += 1
            stress[upcoming] = state @ weight + relaxed[upcoming]
            if upcoming == len(last):
                break
    return stress
