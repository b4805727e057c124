"""How many pixels of a strain field does one core identify in a second?

A record per pixel: 200 instants of a ramp at a rate of the pixel's own (within 30 %), noise of 0.04 MPa, one thread.
"""

import numpy as np

from bench import cases, reference
from bench.forward import row
from bench.rows import Findings, Progress
from bench.timing import take_turns

PIXELS, INSTANTS, NOISE = 500, 200, 0.04


def run(found: Findings, progress: Progress, quick: bool) -> None:
    if quick:
        return
    try:
        from probation import Law, bulk  # noqa: PLC0415 - not in every build
    except ImportError:
        found.skipped.append("identification of a field: this build has no probation.bulk")
        return
    progress(f"identification of {PIXELS} pixels")
    random = np.random.default_rng(6)
    time = np.linspace(0.0, cases.END_STRAIN / cases.RATE, INSTANTS + 1)
    rates = cases.RATE * random.uniform(0.7, 1.0, PIXELS)
    law = (cases.E_U, cases.TAU_MAX, cases.G)
    stress = np.array([reference.ramp(time, rate, *law) for rate in rates])
    stress += NOISE * random.standard_normal(stress.shape)
    strain = rates[:, None] * time
    start = Law(unrelaxed_modulus=2000.0, tau_max=8.0, hardening_modulus=2.0)
    calls = {
        (scheme, method): lambda scheme=scheme, method=method: bulk.identify_many(
            start, time, strain, stress, scheme, method=method, threads=1
        )
        for scheme in ("be2", "sa3")
        for method in ("variable-projection", "levenberg-marquardt")
    }
    timings = take_turns({str(key): call for key, call in calls.items()}, 3)
    for scheme, method in calls:
        timing = timings[str((scheme, method))]
        label = f"{PIXELS} pixels of {INSTANTS} steps, engine {scheme}, {method}"
        note = f"{PIXELS / timing.median:.0f} pixels a second and core"
        found.rows.append(row("field", "ramps", f"{scheme}, {method}", label, timing, {}, note=note))
