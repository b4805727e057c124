"""Are faults of the rig that are put into measured records told: the cause, the record, the size?

.venv/bin/python -m bench.measured_injections [--repeats 4] [--seed 1] [--log FILE.jsonl] [MATERIAL ...]

Against the records themselves ("same"), which share their noise, and ("other samples") every other sample against
those between them, which share none that is not slow.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections import defaultdict
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))
from campaigns import measured
from probation import Reference, compare

WAYS = ("same", "other samples")


def campaigns(material: str, way: str) -> tuple:
    """The reference and the campaign to inject into."""
    if way == "same":
        whole = measured.measured(material)
        return whole, whole
    # Twice as many samples, so that each half has as many.
    fine = measured.measured(material, max(measured.FILES[material][1] // 2, 1))
    return measured.thinned(fine, 2), measured.thinned(fine, 2, first=1)


def study(material: str, way: str, repeats: int, seed: int) -> list[dict]:
    """One row per injection; the first is the null."""
    rng = np.random.default_rng([seed, list(measured.SIZES).index(material), WAYS.index(way)])
    before, after = campaigns(material, way)
    reference = Reference.of(before)
    null = compare(after, reference, threads=1)
    rows = [{"material": material, "way": way, "fault": None, "verdict": null.verdict, "p": null.best.probability}]
    for fault in measured.SIZES[material]:
        for size in range(3):
            for _ in range(repeats):
                done = measured.drawn(after, material, fault, size, rng)
                found = compare(measured.injected(after, done), reference, threads=1)
                told = measured.told(found, after, done)
                rows.append({"material": material, "way": way, "grade": size, **done.to_dict(), **told})
    return rows


def table(rows: list[dict]) -> str:
    """A line per material, way and fault: named at each size, the record, the answer set, the interval."""
    groups = defaultdict(list)
    for row in rows:
        if row["fault"]:
            groups[row["material"], row["way"], row["fault"]].append(row)
    lines = ["| material | against | fault | named: small, medium, plain | record | answer set | interval |"]
    lines.append("|---|---|---|---|---|---|---|")
    for (material, way, fault), group in groups.items():
        named = ", ".join(_share([row["named"] for row in group if row["grade"] == grade]) for grade in range(3))
        seen = [row for row in group if row["covered"] is not None]
        lines.append(
            f"| {material} | {way} | {fault} | {named} | {_share([row['record'] for row in group])} | "
            f"{_share([row['held'] for row in group])} | {_share([row['covered'] for row in seen])} |"
        )
    return "\n".join(lines)


def _share(hits: list[bool]) -> str:
    return f"{sum(hits)}/{len(hits)}"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("materials", nargs="*", default=list(measured.SIZES))
    parser.add_argument("--repeats", type=int, default=4)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--log", type=Path)
    given = parser.parse_args()
    rows = []
    for material in given.materials:
        for way in WAYS:
            rows += study(material, way, given.repeats, given.seed)
            null = next(
                row for row in rows if row["fault"] is None and (row["material"], row["way"]) == (material, way)
            )
            print(f"{material}, {way}: nothing injected: {null['verdict']} ({null['p']:.2f})", flush=True)
    if given.log:
        given.log.write_text("".join(json.dumps(row) + "\n" for row in rows))
    print(table(rows))
    wrong = [row for row in rows if row["fault"] and not row["named"]]
    for row in wrong:
        print(f"{row['material']}, {row['way']}, {row['fault']} {row['size']:.3g}: {row['answer']}")


if __name__ == "__main__":
    main()
