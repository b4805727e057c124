"""How long does one identification of [E_u, tau_max, G] take?

Experiment 1's synthetic record: the ramp, 3224 MPa, 5.207 s, 2.556 MPa, stress noise 0.04 MPa, from a start far off.
scipy's least_squares (trust region reflective) with its defaults throughout, lengths scaled by the start; only the
forward solve and the Jacobian differ. The engine's own searches are timed on many records at once, each with noise of
its own, on one thread: the history, its jumps and a search over all of tau_max included. All use the paper's first
step, so that all must find the same.
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
from bench.timing import Timing, take_turns
from probation import bulk

TRUTH = np.array([3224.0, 5.207, 2.556])
START = np.array([2000.0, 8.0, 2.0])
NOISE = 0.04  # [MPa]
RECORDS = 32
"""How many the engine's own searches are given at once."""


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
    searches = {method: _in_bulk(case, measured, method) for method in bulk.METHODS}
    for method, search in searches.items():
        progress(f"identification: engine, {method}")
        found.identified[method] = search().parameters[0].tolist()
        labels[method] = f"engine, {method}: one of {RECORDS} records at once"
    timings = take_turns(fits | searches, 2 if quick else 7)
    for method in searches:
        timings[method] = Timing(timings[method].rounds / RECORDS)
    for key, timing in timings.items():
        line = row("identification", "experiment 1", key, labels[key], timing, {})
        ratios = {name: timing.over(timings[name]) for name in ("engine", *searches)}
        found.rows.append(replace(line, ratios=ratios))


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
    history = probation.StrainHistory(case.time, case.true_strain, jumps=None)
    scheme = probation.BE2(start="backward_euler")

    def residual(x: Array) -> Array:
        return law.with_parameters(x).stress(history, scheme=scheme) - measured

    def jacobian(x: Array) -> Array:
        return law.with_parameters(x).sensitivity(history, scheme=scheme)[1]

    return lambda: _fit(residual, jacobian)


def _in_bulk(case: cases.Case, measured: Array, method: bulk.Method) -> Callable[[], bulk.BulkIdentification]:
    """The record of the others first; the same experiment with other noise after it."""
    law = probation.Law(unrelaxed_modulus=START[0], tau_max=START[1], hardening_modulus=START[2])
    noise = NOISE * np.random.default_rng(2).standard_normal((RECORDS, len(case.time)))
    records = reference.ramp(case.time, cases.RATE, *TRUTH) + noise
    records[0] = measured
    strains = np.tile(case.true_strain, (RECORDS, 1))
    return lambda: bulk.identify_many(
        law, case.time, strains, records, probation.BE2(start="backward_euler"), method=method, threads=1
    )
