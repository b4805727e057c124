"""What do 10^4 solves with different parameters cost, one by one and as a batch, on one thread and on two?"""

import os
import time
from collections.abc import Callable
from dataclasses import replace

import numpy as np

from bench import cases
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import _core, batch
from probation.law.history import StrainHistory

SOLVES = 10_000
SCHEMES = (("be2", "bE2"), ("sa3", "SA3"))


def run(found: Findings, progress: Progress, quick: bool) -> None:
    if quick:
        return
    case = cases.ramp()
    spread = np.random.default_rng(4).uniform(0.8, 1.25, (SOLVES, 3))
    parameters = engine.law_of(case).parameters * spread
    progress(f"{SOLVES} solves")
    calls = {"one by one": _one_by_one(case, parameters)}
    labels = {"one by one": f"engine bE2, {SOLVES} solves one by one"}
    for scheme, name in SCHEMES:
        calls[scheme] = _batch(case, parameters, scheme)
        labels[scheme] = f"engine {name}, {SOLVES} solves as a batch"
    # Processor time of all threads.
    for key, timing in take_turns(calls, 3, clock=time.process_time_ns).items():
        found.rows.append(row("batch", case.name, key, labels[key], timing, {}))
    _threads(found, progress, case, parameters)


def _threads(found: Findings, progress: Progress, case: cases.Case, parameters: np.ndarray) -> None:
    """Here the clock on the wall counts: the machine must have nothing else to do."""
    progress("batches on one thread and two, into new memory and used")
    calls = {f"{count} threads": _batch(case, parameters, "sa3", count) for count in (1, 2)}
    calls["new output"] = _batch(case, parameters, "sa3", 1, reused=False)
    labels = {
        "1 threads": "engine SA3, 10000 solves on one thread, time on the wall",
        "2 threads": "engine SA3, 10000 solves on two threads, time on the wall",
        "new output": "engine SA3, 10000 solves on one thread, into a new output each time, on the wall",
    }
    timings = take_turns(calls, 5, clock=time.perf_counter_ns)
    for key, label in labels.items():
        entry = row("batch", case.name, key, label, timings[key], {})
        if key == "2 threads" and (os.cpu_count() or 1) < 2:
            found.skipped.append("batches on two threads: this machine has one processor")
            continue
        found.rows.append(replace(entry, ratios={"one thread": timings["1 threads"].over(timings[key])}))


def _one_by_one(case: cases.Case, parameters: np.ndarray) -> Callable[[], object]:
    solver, change, out = engine.solver_of(case, "be2"), _core.LawChange(), np.empty(len(case.time))
    spectrum = _core.Spectrum.log_spaced()
    values = parameters.tolist()

    def call() -> None:
        for E_u, tau_max, G in values:
            solver.stress(_core.Law(E_u, G, tau_max, 1.0, None, spectrum), change, out)

    return call


def _batch(
    case: cases.Case, parameters: np.ndarray, scheme: str, threads: int | None = None, reused: bool = True
) -> Callable[[], object]:
    """Into an output that is used again: first touch of a new one costs more than computing it."""
    law = engine.law_of(case)
    out = np.empty((len(parameters), len(case.time))) if reused else None
    history = StrainHistory(case.time, case.true_strain)
    return lambda: batch.stresses(law, parameters, history, scheme, threads=threads, out=out)
