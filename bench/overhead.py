"""What does a call from Python cost besides the kernel, and what does an older processor lose?"""

import os
import subprocess
import sys
from pathlib import Path

from bench import cases
from bench.cases import Case
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress, Row
from bench.timing import Timing, take_turns
from probation import _core
from probation.law.history import StrainHistory


def run(found: Findings, progress: Progress, quick: bool) -> None:
    progress("call overhead")
    rounds = 3 if quick else 15
    case = cases.ramp()
    one_step = _first(case, 2)
    law, time, strain = engine.law_of(case), case.time, case.true_strain
    history = StrainHistory(time, strain)
    calls = {
        "be2": engine.prepare(case, "be2"),
        "law_be2": engine.prepare_from_arrays(case, "be2"),
        "one step": engine.prepare(one_step, "be2"),
        "law, one step": engine.prepare_from_arrays(one_step, "be2"),
        "history": lambda: StrainHistory(time, strain),
        "find_rate_jumps": lambda: _core.History.find_rate_jumps(time, strain),
        "bare history": lambda: _core.History(time, strain),
        "solver": lambda: _core.Solver(history.engine),
        "e_HT": lambda: _core.haward_thackray_strain(strain),
        "new law": lambda: law.with_parameters((3220.0, 5.2, 2.5)),
    }
    labels = {
        "be2": "compiled call, 2000 steps, out=",
        "law_be2": "law.stress, 2000 steps",
        "one step": "compiled call, 1 step, out=",
        "law, one step": "law.stress, 1 step",
        "history": "  of which: checks, jumps and history",
        "find_rate_jumps": "    of which: looking for rate jumps",
        "bare history": "    of which: the engine's history",
        "e_HT": "      of which: Haward-Thackray strain",
        "solver": "  of which: solver on a history (copies it)",
        "new law": "law.with_parameters",
    }
    timings = take_turns(calls, rounds)
    for key, label in labels.items():
        found.rows.append(row("overhead", case.name, key, label, timings[key], timings))
    beyond = timings["law_be2"].rounds - timings["be2"].rounds
    found.rows.append(row("overhead", case.name, "beyond", "law.stress beyond the compiled call", Timing(beyond), {}))
    if not quick:
        progress("kernels for any processor")
        _older_processor(found)


def _first(case: Case, count: int) -> Case:
    return Case(
        "one step", case.time[:count], case.true_strain[:count], case.strain_rate[:count], case.tau_max,
        case.unrelaxed_modulus, case.hardening_modulus, case.exact[:count],
    )  # fmt: skip


PROBE = """
from bench import cases
from bench.python import engine
from bench.timing import take_turns
calls = {s: engine.prepare(cases.ramp(), s) for s in ("be2", "sa3")}
print(*(t.median for t in take_turns(calls, 9).values()))
"""


def _older_processor(found: Findings) -> None:
    """The same two solves in fresh processes, with the kernels as chosen and with those for any processor."""
    chosen, baseline = _probe(found, ""), _probe(found, "baseline")
    if chosen is None or baseline is None:
        return
    for scheme, here, best in zip(("be2", "sa3"), baseline, chosen, strict=True):
        label = f"engine {scheme}, baseline kernels (any x86-64)"
        found.rows.append(
            Row("overhead", "ramp", f"{scheme}_baseline", label, here, here, 0.0, ratios={"chosen": here / best})
        )


def _probe(found: Findings, build: str) -> list[float] | None:
    environment = {name: value for name, value in os.environ.items() if name != "PROBATION_KERNELS"}
    if build:
        environment["PROBATION_KERNELS"] = build
    root = Path(__file__).resolve().parent.parent
    done = subprocess.run(
        [sys.executable, "-c", PROBE], env=environment, cwd=root, capture_output=True, text=True, check=False
    )
    if done.returncode != 0:
        found.skipped.append(f"the kernels {build or 'as chosen'}: {done.stderr.strip().splitlines()[-1]}")
        return None
    return [float(value) for value in done.stdout.split()]
