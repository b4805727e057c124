"""How much of the gap the diagnosis closes on sealed campaigns, beside a refit that is told the cause.

.venv/bin/python -m bench.closure_of_the_truth SPLIT [--count 40]

SPLIT as `probation blind make` and `solve` left it. Of campaigns with one withheld effect of the catalogue; a refit
that is told the effect takes its catalogue's forms, which are not the laboratory's.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path

import numpy as np

import probation


def closures(split: Path, count: int) -> list[tuple[str, float, float]]:
    """Name, closure by the diagnosis and closure told the cause, of campaigns where there is a gap to close."""
    found = []
    for path in sorted((split / "answers").glob("*.json")):
        answer = json.loads(path.read_text())
        answer = answer.get("diagnosis", answer)
        truth = json.loads((split / "truths" / path.name).read_text())
        truth = json.loads(truth["truth"])
        if truth["stratum"] != "single" or answer["shrink"]["identify"]["closure"] is None:
            continue
        campaign = probation.Campaign.load(split / "campaigns" / path.stem)
        told = probation.diagnose(campaign, effects=truth["explanation"], design=False)
        if told.shrink.identify.closure is not None:
            found.append((path.stem, answer["shrink"]["identify"]["closure"], told.shrink.identify.closure))
        if len(found) == count:
            break
    return found


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("split", type=Path)
    parser.add_argument("--count", type=int, default=40)
    options = parser.parse_args()
    rows = closures(options.split, options.count)
    for name, mine, told in rows:
        print(f"{name}  {mine:7.4f}  told the cause {told:7.4f}")
    mine, told = np.array([row[1:] for row in rows]).T
    print(f"{len(rows)} campaigns: median {np.median(mine):.4f}, told the cause {np.median(told):.4f}; ", end="")
    print(f"at least 0.95 of it in {np.mean(mine >= 0.95 * told):.0%}")


if __name__ == "__main__":
    main()
