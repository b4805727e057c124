"""What does one update cost with fewer modes, and how wrong is the stress then?

Naive: eqs. (4), (5) with another N, tau_max kept. Refitted: the kernel of 50 modes, met by fewer. The error is that
against 50 modes, the scheme's own left out.
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from bench import cases
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import Law, Spectrum, _core

WHOLE = 50
NAIVE = (25, 18)
REFITTED = (("1e-5", 1e-5), ("1e-4", 1e-4), ("1e-3", 1e-3), ("1e-2", 1e-2))

SCHEMES = (("be2", "bE2"), ("sa2", "SA2"), ("sa3", "SA3"))


def run(found: Findings, progress: Progress, quick: bool) -> None:
    """Even steps at constant tau_max, and tau_max by rate, where every update forms its coefficients anew."""
    for case in (cases.ramp(), cases.grips()):
        progress(f"fewer modes: {case.name}")
        laws = laws_by_modes(engine.law_of(case))
        for scheme, label in SCHEMES:
            calls = {key: _call(case, law, scheme) for key, (_, law) in laws.items()}
            reference = calls[str(WHOLE)]().copy()
            errors = {key: float(np.abs(call() - reference).max()) for key, call in calls.items()}
            timings = take_turns(calls, 5 if quick else 15)
            updates = len(case.time) - 1
            for key, (words, _) in laws.items():
                one = timings[key]
                note = f"{1e9 * one.median / updates:.3g} ns an update"
                entry = row(
                    "fewer modes", case.name, f"{scheme}_{key}", f"engine {label}, {words}", one, {}, errors[key], note
                )
                entry.ratios["whole"] = one.over(timings[str(WHOLE)])
                found.rows.append(entry)


def laws_by_modes(law: Law) -> dict[str, tuple[str, Law]]:
    """50 modes, fewer without a refit, fewer with one: each in words, and the law."""
    laws = {str(WHOLE): (f"{WHOLE} modes", law)}
    for modes in NAIVE:
        laws[f"naive {modes}"] = (f"{modes} modes, naive", replace(law, spectrum=Spectrum.log_spaced(modes)))
    for text, accuracy in REFITTED:
        fewer = law.reduced(accuracy=accuracy)
        laws[f"refitted {text}"] = (f"{fewer.modes} modes, refitted to {text}", fewer)
    return laws


def _call(case: cases.Case, law: Law, scheme: str) -> Callable[[], np.ndarray]:
    """The compiled call on a history that the solver holds."""
    solver, held, change, out = engine.solver_of(case, scheme), law.engine, _core.LawChange(), np.empty(len(case.time))

    def call() -> np.ndarray:
        solver.stress(held, change, out)
        return out

    return call
