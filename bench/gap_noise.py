"""How often does the gap test cry wolf on noise that is not its model's, and how often does it see a gap of known size?

.venv/bin/python bench/gap_noise.py [--draws 2000] [--seed 1] [--samples 1000] [--drift 0] [KIND ...]
"""

from __future__ import annotations

import argparse
import sys
import time
from pathlib import Path

import numpy as np
from scipy.stats import beta

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from campaigns import gap_noise
from probation.detection.gap_test import GapTester
from probation.noise.whitening import Whitened

STRENGTHS = (3.0, 5.0, 8.0)


def answer(records: list, drift: float) -> tuple[Whitened, dict[str, np.ndarray], float]:
    """Noise and gap test from the arrays alone, as the diagnosis would."""
    whitened = Whitened.of(records)
    shapes = gap_noise.effects(len(records[0]))
    columns = whitened.whiten([np.column_stack(blocks) for blocks in zip(*shapes.values(), strict=True)])
    directions = dict(zip(shapes, columns.T, strict=True))
    return whitened, directions, GapTester(whitened, directions, drift=drift, size=2000)().p_value


def study(kind: str, draws: int, seed: int, samples: int, drift: float) -> str:
    """One line of the table."""
    rng = np.random.default_rng([seed, gap_noise.KINDS.index(kind)])
    p_values, seen, begin = [], {strength: [] for strength in STRENGTHS}, time.perf_counter()
    shared = [name for name in gap_noise.effects(samples) if " " not in name]
    for draw in range(draws):
        records = gap_noise.records(kind, rng, samples)
        whitened, directions, p_value = answer(records, drift)
        p_values.append(p_value)
        if draw % 10:
            continue
        name = shared[rng.integers(len(shared))]
        amplitude = rng.choice([-1.0, 1.0]) / np.linalg.norm(whitened.project(directions[name]))
        for strength in STRENGTHS:
            changed = gap_noise.with_effect(records, name, strength * amplitude)
            seen[strength].append(answer(changed, drift)[2] < 0.005)
    p = np.array(p_values)
    alarms = int(np.sum(p < 0.005))
    high = beta.ppf(0.975, alarms + 1, draws - alarms)
    power = "  ".join(f"{np.mean(hits):.2f}" for hits in seen.values())
    each = (time.perf_counter() - begin) / draws
    quantiles = "  ".join(f"{np.mean(p < level):.4f}" for level in (0.01, 0.05, 0.2))
    return f"{kind:8s} {draws:6d}  {alarms / draws:.4f} (<= {high:.4f})  {quantiles}   {power}   {each:.2f} s"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("kinds", nargs="*", default=gap_noise.KINDS)
    parser.add_argument("--draws", type=int, default=2000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--samples", type=int, default=1000)
    parser.add_argument("--drift", type=float, default=0.0)
    given = parser.parse_args()
    print("noise     draws  alarms at 0.5 %    p<1 %   p<5 %  p<20 %  seen at 3, 5, 8     each")
    for kind in given.kinds:
        print(study(kind, given.draws, given.seed, given.samples, given.drift), flush=True)


if __name__ == "__main__":
    main()
