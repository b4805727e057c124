"""The ranges that campaigns cover, for `probation/settings/calibrated.py`.

probation blind make --split calibrate --seed 43 --count 60 --out DIR
python -m bench.calibrated_ranges DIR [DIR ...]
"""

from __future__ import annotations

import argparse
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path

from probation.identify.base import base_fit
from probation.identify.fit import plain_fit
from probation.inference.calibration_check import Extent, extent_of
from probation.records.campaign import Campaign


def extent(folder: Path) -> Extent:
    """Of one campaign."""
    campaign = Campaign.load(folder)
    return extent_of(base_fit(campaign, plain_fit(campaign)))


def main() -> None:
    """Print least and most of every range."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("splits", nargs="+", type=Path, help="as probation blind make left them")
    parser.add_argument("--processes", type=int, default=2)
    options = parser.parse_args()
    folders = [folder for split in options.splits for folder in sorted((split / "campaigns").iterdir())]
    with ProcessPoolExecutor(options.processes) as pool:
        found = list(pool.map(extent, folders))
    print(f"{len(found)} campaigns")
    print(f"records       {min(each.records for each in found)} to {max(each.records for each in found)}")
    for name in ("samples", "noise", "strain_noise"):
        low = min(getattr(each, name)[0] for each in found)
        high = max(getattr(each, name)[1] for each in found)
        print(f"{name:<13} {low:.3g} to {high:.3g}")
    for name in ("gap", "scatter"):
        low, high = (end(getattr(each, name) for each in found) for end in (min, max))
        print(f"{name:<13} {low:.3g} to {high:.3g}")
    print(f"law           {', '.join(sorted({each.law for each in found}))}")


if __name__ == "__main__":
    main()
