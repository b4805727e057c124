"""What does a law cost whose relaxation follows its own stress or heat, in solves of the base law?"""

from bench import cases
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns
from probation import Change, SelfHeating, StressActivation

CHANGES = {
    "stress": ("flow activated by stress", Change(feedbacks=(StressActivation(8.0),))),
    "heat": ("self-heating", Change(feedbacks=(SelfHeating(0.3, 4e-3, 0.1, 0.004),))),
}
"""8 MPa; 0.3 degC per MPa, 2 h / (c rho d) of a plate of 4 mm in air, 10 % of tau_max and 0.4 % of G per degC."""

SCHEMES = (("be2", "bE2"), ("sa3", "SA3"))


def run(found: Findings, progress: Progress, quick: bool) -> None:
    for case in (cases.ramp(),) if quick else (cases.ramp(), cases.grips()):
        progress(f"feedbacks: {case.name}")
        calls = {}
        for scheme, _ in SCHEMES:
            base = engine.prepare(case, scheme)
            calls |= {f"{scheme}_{key}@": base for key in CHANGES}
            calls |= {
                f"{scheme}_{key}": engine.prepare(case, scheme, change=change) for key, (_, change) in CHANGES.items()
            }
        timings = take_turns(calls, 3 if quick else 9)
        for scheme, name in SCHEMES:
            for key, (words, _) in CHANGES.items():
                method = f"{scheme}_{key}"
                found.rows.append(
                    row(
                        "feedback", case.name, method, f"engine {name}, {words} ({case.name})", timings[method], timings
                    )
                )
