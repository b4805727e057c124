"""How long does one forward solve take, how wrong is it, and how do the others compare?"""

from bench import cases
from bench.cases import Case
from bench.methods import BE2, CVODE_C, ENGINE, EXACT, NUMBA_FASTMATH, SA2, SA3, UNIFORM, VARIABLE, Method, installed
from bench.rows import Findings, Progress, Row
from bench.timing import Timing, take_turns

YARDSTICKS = (BE2.key, SA3.key, NUMBA_FASTMATH.key)
"""Every row says how many times as long it takes as these."""

QUICK_ROUNDS, ROUNDS = 5, 25


def run(found: Findings, progress: Progress, quick: bool) -> None:
    rounds = QUICK_ROUNDS if quick else ROUNDS
    _compare(found, progress, "forward", cases.ramp(), (*ENGINE, *UNIFORM), rounds)
    short = (BE2, SA2, SA3)
    _compare(found, progress, "forward", cases.uneven_ramp(), (*short, *VARIABLE), rounds)
    if quick:
        return
    grips = cases.grips()
    _compare(found, progress, "forward", grips, (*short, EXACT, CVODE_C, *VARIABLE), rounds, cases.constant_time(grips))
    _compare(found, progress, "forward", cases.jump(), (*short, EXACT, CVODE_C, *VARIABLE), rounds)


def _compare(
    found: Findings,
    progress: Progress,
    section: str,
    case: Case,
    methods: tuple[Method, ...],
    rounds: int,
    beside: Case | None = None,
) -> None:
    """Time the methods on a case, and bE2 and SA3 on the one `beside` it in the same rounds."""
    present = [method for method in methods if installed(method)]
    calls, errors = {}, {}
    for method in present:
        progress(f"{case.name}: {method.label}")
        calls[method.key] = method.prepare(case)
        errors[method.key] = case.error(calls[method.key]())  # compiles, too
    if beside is not None:
        calls |= {f"{method.key}@": method.prepare(beside) for method in (BE2, SA3)}
    progress(f"{case.name}: taking turns")
    timings = take_turns(calls, rounds)
    for method in present:
        found.rows.append(
            row(section, case.name, method.key, method.label, timings[method.key], timings, errors[method.key])
        )


def row(
    section: str,
    case: str,
    key: str,
    label: str,
    timing: Timing,
    timings: dict[str, Timing],
    error: float | None = None,
    note: str = "",
) -> Row:
    """A row with its ratios to the yardsticks and to the same method on the case beside."""
    ratios = {name: timing.over(timings[name]) for name in YARDSTICKS if name in timings}
    if f"{key}@" in timings:
        ratios["beside"] = timing.over(timings[f"{key}@"])
    return Row(section, case, key, label, timing.median, timing.best, timing.spread, error, ratios, note)
