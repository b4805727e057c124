"""How long does one identification of [E_u, tau_max, G] take?

Experiment 1's twin: the ramp, 3224 MPa, 5.207 s, 2.556 MPa, stress noise 0.04 MPa, from a start far off. scipy's
least_squares (trust region reflective) with its defaults throughout, lengths scaled by the start; only the forward
solve and the Jacobian differ. All use the paper's first step, so that all must find the same.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np
from scipy.optimize import least_squares

import probation
from bench import cases, reference
from bench.forward import row
from bench.methods import INSTALL, NUMBA_HOISTED, installed
from bench.rows import Findings, Progress
from bench.spectrum import Array, modes
from bench.timing import take_turns

TRUTH = np.array([3224.0, 5.207, 2.556])
START = np.array([2000.0, 8.0, 2.0])
NOISE = 0.04  # [MPa]


def run(found: Findings, progress: Progress, quick: bool) -> None:
    case = cases.ramp()
    noise = NOISE * np.random.default_rng(1).standard_normal(len(case.time))
    measured = reference.ramp(case.time, cases.RATE, *TRUTH) + noise
    fits = {"engine": _engine(case, measured), "numpy": _numpy(case, measured)}
    if installed(NUMBA_HOISTED):
        fits["numba"] = _numba(case, measured)
    else:
        found.skipped.append(f"identification on numba: not installed ({INSTALL})")
    labels = {
        "engine": "scipy TRF on the engine, law.stress and law.sensitivity",
        "numba": "scipy TRF on numba bE2 (hoisted), differences",
        "numpy": "scipy TRF on numpy bE2 (precomputed), differences",
    }
    for key, fit in fits.items():
        progress(f"identification: {labels[key]}")
        found.identified[key] = fit().tolist()
    timings = take_turns(fits, 2 if quick else 7)
    for key, timing in timings.items():
        line = row("identification", "experiment 1", key, labels[key], timing, {})
        found.rows.append(replace(line, ratios={"engine": timing.over(timings["engine"])}))


def _fit(residual: Callable[[Array], Array], jacobian: Callable[[Array], Array] | str = "2-point") -> Array:
    return least_squares(residual, START, jacobian, bounds=(0.0, np.inf), x_scale=START).x


def _numpy(case: cases.Case, measured: Array) -> Callable[[], Array]:
    from bench.python.numpy_be2 import precomputed  # noqa: PLC0415

    return _by_differences(case, measured, precomputed)


def _numba(case: cases.Case, measured: Array) -> Callable[[], Array]:
    from bench.python.numba_be2_hoisted import stress  # noqa: PLC0415

    return _by_differences(case, measured, stress)


def _by_differences(case: cases.Case, measured: Array, stress: Callable[..., Array]) -> Callable[[], Array]:
    ratio, weight = modes()
    h, hardening = case.time[1] - case.time[0], case.hardening

    def residual(x: Array) -> Array:
        return stress(h, case.strain_rate, hardening, x[0], x[2], x[1] * ratio, weight) - measured

    return lambda: _fit(residual)


def _engine(case: cases.Case, measured: Array) -> Callable[[], Array]:
    law = probation.Law(unrelaxed_modulus=START[0], tau_max=START[1], hardening_modulus=START[2])
    options = {"scheme": "be2", "start": "backward_euler", "jumps": None}

    def residual(x: Array) -> Array:
        return law.with_parameters(x).stress(case.time, case.true_strain, **options) - measured

    def jacobian(x: Array) -> Array:
        return law.with_parameters(x).sensitivity(case.time, case.true_strain, **options)[1]

    return lambda: _fit(residual, jacobian)
