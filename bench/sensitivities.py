"""What do the sensitivities to E_u, tau_max and G cost, in forward solves?"""

import numpy as np

from bench import cases
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import _core


def run(found: Findings, progress: Progress, quick: bool) -> None:
    case = cases.ramp()
    calls = {}
    for scheme in ("be2", "sa3"):
        progress(f"sensitivities: {scheme}")
        calls[f"{scheme}@"] = engine.prepare(case, scheme)
        calls[scheme] = _tangent(case, scheme)
    law = engine.law_of(case)
    calls["law"] = lambda: law.sensitivity(case.time, case.true_strain)
    timings = take_turns(calls, 3 if quick else 15)
    for scheme, name in (("be2", "bE2"), ("sa3", "SA3")):
        label = f"engine {name}, stress and three sensitivities"
        found.rows.append(row("sensitivities", case.name, scheme, label, timings[scheme], timings))
    found.rows.append(row("sensitivities", case.name, "law", "law.sensitivity from arrays", timings["law"], timings))


def _tangent(case: cases.Case, scheme: str):
    solver, law, change = engine.solver_of(case, scheme), engine.law_of(case).engine, _core.LawChange()
    directions = _core.parameter_directions(law, change, solver.history)
    stress, derivatives = np.empty(len(case.time)), np.empty((len(case.time), len(directions)))
    return lambda: solver.tangent(law, change, directions, stress, derivatives)
