"""A comparison of two campaigns as text."""

from __future__ import annotations

from textwrap import fill
from typing import TYPE_CHECKING

from probation.comparison.headline import named, sized
from probation.report.skipped_words import MOST as MOST_SKIPPED
from probation.report.skipped_words import skipped_lines
from probation.wording import WIDTH, chance

if TYPE_CHECKING:
    from probation.comparison.result import Comparison

MOST = 6


def comparison_summary(found: Comparison) -> str:
    """The headline, then every explanation of the answer set and the next ones, then the records."""
    lines = [f"{found.campaign}: {found.headline}", ""]
    for each in found.explanations[:MOST]:
        star = "*" if each in found.answer_set else " "
        where = ", ".join(each.records)
        text = f"{star} {chance(each.probability):>6}  {named(each)}" + (f" in {where}" if where else "")
        lines.append(fill(text, WIDTH, subsequent_indent=12 * " "))
        lines += [f"            {sized(parameter)}" for parameter in each.parameters]
    lines.append("")
    for name, others in found.pairs.items():
        text = (
            f"{name} against {', '.join(others)}: the change is {found.rms_MPa[name]:.3g} MPa rms, the noise "
            f"{found.noise_MPa[name]:.3g} MPa"
        )
        lines.append(f"  {text}")
    if found.scatter.any:
        lines.append(f"  {found.scatter.text}.")
    lines += [f"  left out: {each}" for each in skipped_lines(found.skipped, MOST_SKIPPED)]
    lines += [f"  warning: {each}" for each in found.warnings]
    return "\n".join(lines)
