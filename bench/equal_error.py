"""How much time does each method need to reach 0.1 % of the largest stress, and 1e-3 MPa?

The ramp's stress is wanted at 200 even instants (every 1 % of strain), and that is where the largest error is taken.
Fixed steps: the fewest steps per instant that do. Adaptive methods: the loosest tolerance (half decades) that does.
"""

from collections.abc import Callable

import numpy as np

from bench import cases
from bench.cases import Case
from bench.forward import row
from bench.methods import (
    BDF,
    BE2,
    BE2_PAPER,
    CVODE_C,
    LFILTER,
    LSODA,
    NUMBA_BE2,
    NUMBA_FASTMATH,
    NUMBA_SA2,
    NUMPY,
    RADAU,
    SA2,
    SA3,
    SUNDAE,
    Method,
    installed,
)
from bench.rows import Findings, Progress
from bench.spectrum import Array
from bench.timing import take_turns

INSTANTS = 200
STEPS_PER_INSTANT = tuple(sorted({round(1.25**k) for k in range(28)}))
TOLERANCES = tuple(10.0 ** (-k / 2) for k in range(2, 21))
METHODS = (
    BE2, BE2_PAPER, SA2, SA3, CVODE_C, NUMBA_BE2, NUMBA_FASTMATH, NUMBA_SA2, NUMPY, LFILTER, BDF, LSODA, RADAU, SUNDAE,
)  # fmt: skip


def run(found: Findings, progress: Progress, quick: bool) -> None:
    largest = float(np.abs(cases.ramp(INSTANTS).exact).max())
    for name, target in (("0.1 % of the largest stress", 1e-3 * largest), ("1e-3 MPa", 1e-3)):
        calls, setting, errors = {}, {}, {}
        present = [method for method in METHODS if installed(method)]
        for method in present:
            progress(f"time to {name}: {_plain(method)}")
            best = _loosest(method, target)
            if best is None:
                found.skipped.append(f"{method.label} does not reach {name} within the steps or tolerances tried")
                continue
            calls[method.key], errors[method.key], setting[method.key] = best
        timings = take_turns(calls, 3 if quick else 9)
        for method in present:
            if method.key in calls:
                label = _plain(method)
                found.rows.append(
                    row("equal error", name, method.key, label, timings[method.key], timings, errors[method.key],
                        setting[method.key])
                )  # fmt: skip


def _loosest(method: Method, target: float) -> tuple[Callable[[], Array], float, str] | None:
    """The cheapest call that meets the target, its error and its setting; a tolerance that fails is passed over."""
    if method.tolerance_name:
        case = cases.ramp(INSTANTS)
        for tolerance in TOLERANCES:
            options = {method.tolerance_name: tolerance}
            if method is CVODE_C:
                options["absolute_tolerance"] = tolerance
            call = method.prepare(case, **options)
            try:
                error = case.error(call())
            except RuntimeError:  # scipy Radau fails now and then on the last step
                continue
            if error <= target:
                return call, error, f"rtol {tolerance:.1e}"
        return None
    for per_instant in STEPS_PER_INSTANT:
        case = cases.ramp(INSTANTS * per_instant)
        call = method.prepare(case)
        error = _error_at_instants(case, call(), per_instant)
        if error <= target:
            return call, error, f"{INSTANTS * per_instant} steps"
    return None


def _error_at_instants(case: Case, stress: Array, per_instant: int) -> float:
    return float(np.abs(stress - case.exact)[::per_instant].max())


def _plain(method: Method) -> str:
    """Its name without the tolerance, which is sought here."""
    return method.label.split(", rtol")[0]
