"""What does a feedback cost, in solves of the law without it, and what do sensitivities cost beside it?"""

import numpy as np

from bench import cases
from bench.cases import Case
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import PowerActivation, SelfHeating, StressActivation, _core

FEEDBACKS = {
    "stress activation": StressActivation(20.0),
    "power activation": PowerActivation(30.0, 2.5),
    "self-heating": SelfHeating(1.0, 0.02, 0.03, 0.01),
}
SCHEMES = {"be2": "bE2", "sa2": "SA2", "sa3": "SA3"}
SECTION = "feedbacks"


def run(found: Findings, progress: Progress, quick: bool) -> None:
    records = [cases.ramp(), cases.uneven_ramp()] + ([] if quick else [cases.grips()])
    for case in records:
        for scheme in SCHEMES:
            progress(f"feedbacks: {case.name}, {scheme}")
            _compare(found, case, scheme, 3 if quick else 15)


def _compare(found: Findings, case: Case, scheme: str, rounds: int) -> None:
    """Every feedback on a record, beside the same record without any and beside the ramp in even steps."""
    calls = {"none": _stress(case, scheme), "even": _stress(cases.ramp(), scheme)}
    for name, feedback in FEEDBACKS.items():
        calls[name] = _stress(case, scheme, feedback)
        calls[f"{name}, sensitivities"] = _tangent(case, scheme, feedback)
    timings = take_turns(calls, rounds)
    for name in FEEDBACKS:
        for what in (name, f"{name}, sensitivities"):
            label = f"engine {SCHEMES[scheme]}, {case.name}, {name}" + (" and three sensitivities" * (what != name))
            made = row(SECTION, case.name, f"{scheme}, {what}", label, timings[what], timings)
            made.ratios["beside"] = timings[what].over(timings["none"])
            made.ratios["even"] = timings[what].over(timings["even"])
            found.rows.append(made)


def _changed(feedback: object | None) -> _core.LawChange:
    change = _core.LawChange()
    if feedback is not None:
        change.feedbacks = [feedback]
    return change


def _stress(case: Case, scheme: str, feedback: object | None = None):
    solver, law, change = engine.solver_of(case, scheme), engine.law_of(case).engine, _changed(feedback)
    out = np.empty(len(case.time))
    return lambda: solver.stress(law, change, out)


def _tangent(case: Case, scheme: str, feedback: object):
    solver, law, change = engine.solver_of(case, scheme), engine.law_of(case).engine, _changed(feedback)
    directions = _core.parameter_directions(law, change, solver.history)
    stress, derivatives = np.empty(len(case.time)), np.empty((len(case.time), len(directions)))
    return lambda: solver.tangent(law, change, directions, stress, derivatives)
