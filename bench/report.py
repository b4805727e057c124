"""How is the result read? The verdict first, then the table with ratios, then details."""

from typing import Any

from bench.identification import TRUTH
from bench.instructions import CASES
from bench.rows import Findings, Row
from bench.targets import GOALS, REQUIRED, Target

WORDS = {True: "met", False: "NOT MET", None: "no number"}


def lines(found: Findings, machine: dict[str, object]) -> list[str]:
    return [
        *_verdict(found),
        "",
        *_forward(found),
        *_plain(found, "limit", "Fused multiply-adds: what the machine does of them, and what a solve takes"),
        *_fewer_modes(found),
        *_equal_error(found),
        *_plain(found, "overhead", "Calls from Python"),
        *_plain(found, "sensitivities", "Sensitivities"),
        *_plain(found, "feedbacks", "Feedbacks, beside one solve without (even: of the ramp in even steps)"),
        *_plain(found, "batch", "Batches (processor time of all threads)"),
        *_identification(found),
        *_plain(found, "field", "Identification of a strain field, one record per pixel"),
        *_instructions(found),
        *_goals(found),
        *_machine(machine),
        *(f"Skipped: {line}" for line in found.skipped),
    ]


def _verdict(found: Findings) -> list[str]:
    states = [target.met(found) for target in REQUIRED]
    head = "Required speed: " + (
        "reached." if all(states) else "NOT REACHED." if False in states else "not everything could be measured."
    )
    return [head, *(_target(target, found) for target in REQUIRED)]


def number(value: float | None, unit: str) -> str:
    """Three digits and the unit."""
    return "-" if value is None else f"{value:.3g}{unit}" if value < 1000 else f"{value:.0f}{unit}"


def _target(target: Target, found: Findings) -> str:
    reached = number(target.value(found), target.unit)
    sense = ">=" if target.at_least else "<="
    wanted = f"(wanted {sense} {target.limit:g}{target.unit})"
    return f"  {WORDS[target.met(found)]:>9}  {reached:>12}  {wanted:<22}  {target.item}"


def _forward(found: Findings) -> list[str]:
    out = []
    cases = dict.fromkeys(row.case for row in found.rows if row.section == "forward")
    for case in cases:
        out += [f"Forward solve, {case}: 50 modes, 2000 steps or so", _header("largest error")]
        out += [_line(row) for row in found.rows if row.section == "forward" and row.case == case]
        out.append("")
    return out


def _fewer_modes(found: Findings) -> list[str]:
    rows = [row for row in found.rows if row.section == "fewer modes"]
    out = []
    for case in dict.fromkeys(row.case for row in rows):
        out += [
            f"Fewer modes, {case}: error against 50 modes",
            f"  {'':<62}{'median':>10} {'':>6}{'error':>16}{'/ 50':>9}",
        ]
        for row in rows:
            if row.case == case:
                time = f"{_time(row.median):>10} +-{row.spread / 2:>4.0%}"
                error = f"{row.error:.1e} MPa"
                out.append(f"  {f'{row.label}, {row.note}':<62}{time}{error:>16}{_ratio(row.ratios['whole']):>9}")
        out.append("")
    return out


def _equal_error(found: Findings) -> list[str]:
    out = []
    cases = dict.fromkeys(row.case for row in found.rows if row.section == "equal error")
    for case in cases:
        out += [f"Time to {case}, at 200 instants of the ramp", _header("largest error")]
        out += [_line(row) for row in found.rows if row.section == "equal error" and row.case == case]
        out.append("")
    return out


def _plain(found: Findings, section: str, title: str) -> list[str]:
    rows = [row for row in found.rows if row.section == section]
    if not rows:
        return []
    out = [title]
    for row in rows:
        extra = ""
        if "beside" in row.ratios:
            extra = f"  {row.ratios['beside']:.2f} x one solve"
        if "even" in row.ratios:
            extra += f"  {row.ratios['even']:.2f} x even"
        if "chosen" in row.ratios:
            extra = f"  {row.ratios['chosen']:.2f} x those chosen here"
        if "limit" in row.ratios:
            extra = f"  {1 / row.ratios['limit']:.0%} of the limit"
        if "quasi-steady limit" in row.ratios:
            extra += f", {1 / row.ratios['quasi-steady limit']:.0%} with quasi-steady fast modes"
        if "one thread" in row.ratios:
            extra = f"  {row.ratios['one thread']:.2f} x as fast as one thread into a used output"
        if row.note:
            extra += f"  {row.note}"
        out.append(f"  {row.label:<66}{_time(row.median):>11} +-{row.spread / 2:>4.0%}{extra}")
    return [*out, ""]


def _identification(found: Findings) -> list[str]:
    out = _plain(found, "identification", f"One identification of [E_u, tau_max, G] from 2001 points; truth {TRUTH}")
    for key, values in found.identified.items():
        out.insert(-1, f"    {key}: " + ", ".join(f"{value:.6g}" for value in values))
    for row in found.rows:
        if row.section == "identification" and row.method != "engine":
            out.insert(-1, f"    {row.method} takes {row.ratios['engine']:.1f} times as long as the engine")
    return out


def _instructions(found: Findings) -> list[str]:
    if not found.instructions:
        return []
    counts = (f"  {CASES[case]:<66}{count:>8.2f}" for case, count in found.instructions.items())
    return ["Instructions for one mode and step", *counts, ""]


def _goals(found: Findings) -> list[str]:
    states = [target.met(found) for target in GOALS]
    head = f"Target table: {states.count(True)} of {len(states)} rows met, {states.count(None)} without a number"
    return [head, *(_target(target, found) for target in GOALS), ""]


def _machine(machine: dict[str, Any]) -> list[str]:
    changed = " (modified)" if machine["modified"] else ""
    return [
        f"Measured on {machine['cpu']}, {machine['processors']} processors; {machine['system']}",
        f"  commit {machine['commit']}{changed}, {machine['compiler']}, kernels {machine['kernels']}",
        f"  flags {machine['flags']}",
        *(f"  kernels {name}: {flags}" for name, flags in machine["kernel_flags"].items()),
    ]


def _header(error: str) -> str:
    return f"  {'':<74}{'median':>10} {'':>6}{error:>16}{'/ bE2':>9}{'/ SA3':>9}"


def _line(row: Row) -> str:
    label = f"{row.label}, {row.note}" if row.note else row.label
    error = "" if row.error is None else f"{row.error:.1e} MPa"
    ratios = "".join(f"{_ratio(row.ratios.get(name)):>9}" for name in ("be2", "sa3"))
    return f"  {label:<74}{_time(row.median):>10} +-{row.spread / 2:>4.0%}{error:>16}{ratios}"


def _ratio(value: float | None) -> str:
    return "" if value is None else f"{value:.3g}" if value < 1000 else f"{value:.0f}"


def _time(seconds: float) -> str:
    return f"{seconds * 1e6:.3g} us" if seconds < 1e-3 else f"{seconds * 1e3:.3g} ms"
