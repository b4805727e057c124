"""How long does a call take, on a machine that does other things too?

The calls take turns, round after round, so that a slow spell of the machine hits them all; what is counted is the
processor time of this thread, so that waiting for a processor is not. Ratios are taken within rounds.
"""

import gc
import math
import time
from collections.abc import Callable, Mapping
from dataclasses import dataclass

import numpy as np

from bench.spectrum import Array

SLICE = 2e-3
"""A short call is repeated until it fills this time [s]."""


@dataclass(frozen=True)
class Timing:
    """Processor time of one call, per round [s]."""

    rounds: Array

    @property
    def median(self) -> float:
        return float(np.median(self.rounds))

    @property
    def best(self) -> float:
        return float(self.rounds.min())

    @property
    def spread(self) -> float:
        """Distance of the quartiles over the median."""
        low, high = np.percentile(self.rounds, [25, 75])
        return float((high - low) / self.median)

    def over(self, other: "Timing") -> float:
        """How many times as long as the other, round by round."""
        return float(np.median(self.rounds / other.rounds))


def take_turns(
    calls: Mapping[str, Callable[[], object]], rounds: int, clock: Callable[[], int] = time.thread_time_ns
) -> dict[str, Timing]:
    """Time every call `rounds` times, in turns; the first call of each is not counted (it may compile)."""
    repeats = {}
    for key, call in calls.items():
        call()
        start = time.perf_counter()
        call()
        repeats[key] = min(2000, math.ceil(SLICE / max(time.perf_counter() - start, 1e-9)))
    taken = {key: np.empty(rounds) for key in calls}
    gc.collect()
    gc.disable()
    try:
        for i in range(rounds):
            for key, call in calls.items():
                times = range(repeats[key])
                start = clock()
                for _ in times:
                    call()
                taken[key][i] = (clock() - start) / len(times) * 1e-9
    finally:
        gc.enable()
    return {key: Timing(values) for key, values in taken.items()}
