"""What fraction of the machine's fused multiply-adds does a solve reach?

A solve of 50 modes holds them in 13 vectors of four. bE2 needs 3 multiply-adds a mode and step, SA2 and SA3 need 2;
with its fast modes quasi-steady, SA3 needs them on 7 of the 13. The limit is measured in the same rounds: as many
independent multiply-adds on 256-bit vectors as the solve needs, and nothing else.
"""

import ctypes
from collections.abc import Callable

from bench import cases, compiled
from bench.forward import row
from bench.python import engine
from bench.rows import Findings, Progress
from bench.timing import take_turns

VECTORS, INTEGRATED_VECTORS = 13, 7
NEEDED = {"be2": 3 * VECTORS, "sa2": 2 * VECTORS, "sa3": 2 * VECTORS, "quasi_steady": 2 * INTEGRATED_VECTORS}
"""Multiply-adds of one vector, per step."""

LABELS = {"be2": "bE2", "sa2": "SA2", "sa3": "SA3"}


def run(found: Findings, progress: Progress, quick: bool) -> None:
    progress("limit of fused multiply-adds")
    library, why = compiled.built(compiled.FMA)
    if library is None:
        found.skipped.append(f"the limit of fused multiply-adds: {why}")
        return
    multiply_add = ctypes.CDLL(str(library)).fma_limit
    multiply_add.argtypes, multiply_add.restype = [ctypes.c_long], ctypes.c_double
    case = cases.ramp()
    steps = len(case.time) - 1

    def limit(needed: int) -> Callable[[], float]:
        return lambda: multiply_add(needed * steps)

    calls: dict[str, Callable[[], object]] = {f"limit_{key}": limit(needed) for key, needed in NEEDED.items()}
    calls |= {scheme: engine.prepare(case, scheme) for scheme in LABELS}
    timings = take_turns(calls, 5 if quick else 25)
    for key, needed in NEEDED.items():
        what = "SA3, quasi-steady fast modes" if key == "quasi_steady" else LABELS[key]
        label = f"limit of {what}: {needed} multiply-adds a step"
        found.rows.append(row("limit", case.name, f"limit_{key}", label, timings[f"limit_{key}"], {}))
    for scheme, name in LABELS.items():
        entry = row("limit", case.name, scheme, f"engine {name}", timings[scheme], {})
        entry.ratios["limit"] = timings[scheme].over(timings[f"limit_{scheme}"])
        if scheme != "be2":
            entry.ratios["quasi-steady limit"] = timings[scheme].over(timings["limit_quasi_steady"])
        found.rows.append(entry)
