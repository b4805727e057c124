"""The target table as README.md holds it."""

from bench.instructions import CASES
from bench.report import WORDS, number
from bench.rows import Findings
from bench.targets import GOALS, REQUIRED, Target


def lines(found: Findings, machine: dict[str, object]) -> list[str]:
    states = [target.met(found) for target in GOALS]
    where = f"{machine['cpu']}, {machine['processors']} processors, {machine['compiler']}, kernels {machine['kernels']}"
    return [
        f"{where}; commit {machine['commit']}.",
        f"{states.count(True)} of {len(states)} rows met.",
        "",
        "| aim | wanted | reached | | what limits it |",
        "|---|---|---|---|---|",
        *(_line(target, found) for target in (*REQUIRED, *GOALS)),
        "",
        *_limits(found),
        *_instructions(found),
    ]


def _line(target: Target, found: Findings) -> str:
    sense = "≥" if target.at_least else "≤"
    reached = number(target.value(found), target.unit)
    limited = target.limited_by(found) if target.limited_by else ""
    cells = (target.item, f"{sense} {target.limit:g}{target.unit}", reached, WORDS[target.met(found)], limited)
    return f"| {' | '.join(cells)} |"


def _limits(found: Findings) -> list[str]:
    rows = [row for row in found.rows if row.section == "limit" and "limit" in row.ratios]
    if not rows:
        return []
    head = "| even steps | time | fraction of the FMA limit | with quasi-steady fast modes |"
    out = [head, "|---|---|---|---|"]
    for row in rows:
        quasi_steady = row.ratios.get("quasi-steady limit")
        part = "" if quasi_steady is None else f"{1 / quasi_steady:.0%}"
        out.append(f"| {row.label} | {row.best * 1e6:.3g} µs | {1 / row.ratios['limit']:.0%} | {part} |")
    return [*out, ""]


def _instructions(found: Findings) -> list[str]:
    if not found.instructions:
        return []
    out = ["| kernel | instructions a mode and step |", "|---|---|"]
    return [*out, *(f"| {CASES[case]} | {count:.2f} |" for case, count in found.instructions.items())]
