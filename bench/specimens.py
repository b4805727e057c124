"""Do the intervals of the specimens' scatter hold it, and do specimens that differ pass for a gap?

`python -m bench.specimens [COUNT]`: COUNT small campaigns (40 if left out) of each kind, all without a gap; about
three seconds each. Three rates; E_u, alpha and G of the specimens scatter by 2, 3 and 3 %, their sections by 1 % and
the start of their strain by 1e-3. Replicated: three specimens a rate. Single: one a rate, and the scatter is assumed.
"""

from __future__ import annotations

import sys
import time

import numpy as np
from tests.campaigns.replicates import SCATTER, replicates

from probation.effects.registry import effects
from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.gap import find_gap

KINDS = {"replicated, 3 a rate": 3, "replicated, 2 a rate": 2, "single": 1}


def measured(seed: int, count: int) -> tuple[bool, list[bool], list[float], list[bool]]:
    """False alarm; by deviation whether its interval holds it, and the estimate; whether parameters are within 2 se."""
    campaign = replicates(seed, count)
    considered = effects()
    base = base_fit(campaign, plain_fit(campaign, "sa3", None)).screened(considered)
    gap = find_gap(base, considered)
    scatter = base.scatter
    held = [
        low <= SCATTER[name] <= high for name, (low, high) in zip(scatter.names, scatter.intervals or (), strict=False)
    ]
    truth = np.array([3000.0, 1.0, 2.5])
    error = np.abs(base.parameters - truth) / np.sqrt(np.diag(base.covariance))
    return gap.in_fitted, held, list(scatter.deviations), (error < 2.0).tolist()


def main(number: int) -> None:
    """Print a line for each kind."""
    for title, count in KINDS.items():
        began = time.perf_counter()
        found = [measured(seed, count) for seed in range(number)]
        alarms = sum(each[0] for each in found)
        print(f"{title}: {alarms} of {number} false alarms; {(time.perf_counter() - began) / number:.1f} s each")
        if found[0][1]:
            print("  intervals that hold the truth:", np.mean([each[1] for each in found], axis=0).round(3).tolist())
            print("  median estimates:", np.median([each[2] for each in found], axis=0).round(4).tolist())
        print(
            "  parameters within two standard errors:", np.mean([each[3] for each in found], axis=0).round(3).tolist()
        )


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 40)
