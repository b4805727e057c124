"""What do 10^4 solves with different parameters cost, one by one and as a batch?"""

import time
from collections.abc import Callable

import numpy as np

from bench import cases
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import _core, batch
from probation.history import make_history

SOLVES = 10_000


def run(found: Findings, progress: Progress, quick: bool) -> None:
    if quick:
        return
    case = cases.ramp()
    spread = np.random.default_rng(4).uniform(0.8, 1.25, (SOLVES, 3))
    parameters = engine.law_of(case).parameters * spread
    progress(f"{SOLVES} solves")
    calls = {"one by one": _one_by_one(case, parameters), "batch": _batch(case, parameters)}
    # Processor time of all threads.
    for key, timing in take_turns(calls, 3, clock=time.process_time_ns).items():
        label = f"engine bE2, {SOLVES} solves {'as a batch' if key == 'batch' else key}"
        found.rows.append(row("batch", case.name, key, label, timing, {}))


def _one_by_one(case: cases.Case, parameters: np.ndarray) -> Callable[[], object]:
    solver, change, out = engine.solver_of(case, "be2"), _core.LawChange(), np.empty(len(case.time))
    spectrum = _core.Spectrum.log_spaced()
    values = parameters.tolist()

    def call() -> None:
        for E_u, tau_max, G in values:
            solver.stress(_core.Law(E_u, G, tau_max, 1.0, None, spectrum), change, out)

    return call


def _batch(case: cases.Case, parameters: np.ndarray) -> Callable[[], object]:
    """Into an output that is used again: first touch of a new one costs more than computing it."""
    law, out = engine.law_of(case), np.empty((len(parameters), len(case.time)))
    history = make_history(case.time, case.true_strain)
    return lambda: batch.stresses(law, parameters, history, "be2", out=out)
