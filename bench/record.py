"""What did the last recorded run find, and how does this one differ?"""

import csv
import json
import math
from datetime import UTC, datetime
from pathlib import Path

from bench.rows import Findings, Row
from bench.targets import GOALS, REQUIRED

RESULTS = Path(__file__).resolve().parent / "results"

COUNTS = "instructions.csv"

COLUMNS = (
    "section", "case", "method", "label", "median_us", "best_us", "spread", "error_MPa",
    "ratio_to_be2", "ratio_to_sa3", "ratio_to_numba_fastmath", "note",
)  # fmt: skip

NOTICEABLE = 0.2
"""Changes below this are noise."""

NOTICEABLE_COUNT = 0.02
"""Instruction counts do not depend on what else the machine does."""

OURS = ("overhead", "sensitivities", "batch", "fewer modes", "feedback", "field")
"""Sections in which every row is the engine's; elsewhere its label says so."""


def as_dict(row: Row) -> dict[str, object]:
    ratios = {name: row.ratios.get(name) for name in ("be2", "sa3", "numba_be2_fastmath")}
    values = (
        row.section, row.case, row.method, row.label.strip(), _digits(row.median * 1e6), _digits(row.best * 1e6),
        _digits(row.spread), _digits(row.error), *(_digits(value) for value in ratios.values()), row.note,
    )  # fmt: skip
    return dict(zip(COLUMNS, values, strict=True))


def as_json(found: Findings, machine: dict[str, object]) -> str:
    targets = {
        name: [
            {"item": t.item, "reached": t.value(found), "limit": t.limit, "at_least": t.at_least, "met": t.met(found)}
            for t in group
        ]
        for name, group in (("required", REQUIRED), ("goals", GOALS))
    }
    everything = {
        "metadata": machine,
        "targets": targets,
        "rows": [as_dict(row) for row in found.rows],
        "identified": found.identified,
        "instructions_per_mode_and_step": found.instructions,
        "skipped": found.skipped,
    }
    return json.dumps(everything, indent=2)


def write(found: Findings, machine: dict[str, object]) -> Path:
    """The folder `<date>-<commit>` with metadata.json and summary.csv."""
    now = datetime.now(UTC)
    folder = RESULTS / f"{now:%Y-%m-%d}-{machine['commit']}"
    folder.mkdir(parents=True, exist_ok=True)
    metadata = {"recorded": f"{now:%Y-%m-%dT%H:%M:%SZ}", **machine, "skipped": found.skipped}
    (folder / "metadata.json").write_text(json.dumps(metadata, indent=2) + "\n", encoding="utf-8")
    with (folder / "summary.csv").open("w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(as_dict(row) for row in found.rows)
    if found.instructions:
        with (folder / COUNTS).open("w", newline="", encoding="utf-8") as file:
            counts = csv.writer(file, lineterminator="\n")
            counts.writerow(("kernel", "instructions_per_mode_and_step"))
            counts.writerows((case, f"{count:.4f}") for case, count in found.instructions.items())
    return folder


def compare(found: Findings, machine: dict[str, object]) -> list[str]:
    """Lines on the engine's rows beside the last recorded run; to be called before `write`."""
    last = _last()
    if last is None:
        return ["No earlier run is recorded."]
    metadata, rows, counts = last
    lines = [f"Beside the run of {metadata['recorded'][:10]} at {metadata['commit']}:"]
    same = metadata["cpu"] == machine["cpu"] and metadata["kernels"] == machine["kernels"]
    if not same:
        lines.append("  another machine, so only ratios to numba fastmath are compared")
    compared = changed = 0
    for row in (row for row in found.rows if row.section in OURS or "engine" in row.label):
        before = rows.get((row.section, row.case, row.method))
        factor = None if before is None else _change(row, before, same)
        if factor is None:
            continue
        compared += 1
        if abs(factor - 1) > NOTICEABLE:
            changed += 1
            word = "slower" if factor > 1 else "faster"
            lines.append(f"  {max(factor, 1 / factor):.2f} times {word}: {row.label.strip()} ({row.case})")
    lines.append(f"  {compared - changed} of {compared} rows within {NOTICEABLE:.0%}")
    return [*lines, *_compare_counts(found, counts, same_build=metadata["compiler"] == machine["compiler"])]


def _compare_counts(found: Findings, before: dict[str, float], same_build: bool) -> list[str]:
    if not found.instructions:
        return []
    if not before:
        return ["  no instruction counts were recorded then"]
    lines = [] if same_build else ["  another compiler, so instruction counts may differ for that alone"]
    compared = [(case, count / before[case]) for case, count in found.instructions.items() if case in before]
    moved = [(case, factor) for case, factor in compared if abs(factor - 1) > NOTICEABLE_COUNT]
    lines += [f"  {factor - 1:+.1%} instructions: {case}" for case, factor in moved]
    return [
        *lines,
        f"  {len(compared) - len(moved)} of {len(compared)} instruction counts within {NOTICEABLE_COUNT:.0%}",
    ]


def _change(row: Row, before: dict[str, str], same_machine: bool) -> float | None:
    """Time now over time then: as it is (same machine), and by the ratio to numba fastmath in the same rounds.

    A change of the engine shows in both, a noisy yardstick or a slow spell in one: the smaller of the two is taken.
    """
    changes = []
    then, now = before["ratio_to_numba_fastmath"], row.ratios.get("numba_be2_fastmath")
    if then and now:
        changes.append(now / float(then))
    if same_machine:
        changes.append(row.median * 1e6 / float(before["median_us"]))
    return min(changes, key=lambda factor: abs(math.log(factor)), default=None)


def _last() -> tuple[dict[str, str], dict[tuple[str, str, str], dict[str, str]], dict[str, float]] | None:
    runs = []
    for path in RESULTS.glob("*/metadata.json"):
        metadata = json.loads(path.read_text(encoding="utf-8"))
        runs.append((metadata["recorded"], path, metadata))
    if not runs:
        return None
    _, path, metadata = max(runs)
    with path.with_name("summary.csv").open(encoding="utf-8") as file:
        rows = {(row["section"], row["case"], row["method"]): row for row in csv.DictReader(file)}
    counts = path.with_name(COUNTS)
    if not counts.exists():
        return metadata, rows, {}
    with counts.open(encoding="utf-8") as file:
        lines = csv.DictReader(file)
        return metadata, rows, {line["kernel"]: float(line["instructions_per_mode_and_step"]) for line in lines}


def _digits(value: float | None) -> float | None:
    return None if value is None else float(f"{value:.4g}")
