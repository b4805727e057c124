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

MOST_EXPLANATIONS = 6


def comparison_summary(comparison: Comparison) -> str:
    """The headline, then every explanation of the answer set and the next ones, then the records."""
    lines = [f"{comparison.campaign}: {comparison.headline}", ""]
    for explanation in comparison.explanations[:MOST_EXPLANATIONS]:
        star = "*" if explanation in comparison.answer_set else " "
        where = ", ".join(explanation.records)
        text = f"{star} {chance(explanation.probability):>6}  {named(explanation)}" + (f" in {where}" if where else "")
        lines.append(fill(text, WIDTH, subsequent_indent=12 * " "))
        lines += [f"            {size}" for size in sized(explanation)]
    lines.append("")
    for name, others in comparison.pairs.items():
        text = (
            f"{name} against {', '.join(others)}: the change is {comparison.rms_MPa[name]:.3g} MPa rms, the noise "
            f"{comparison.noise_MPa[name]:.3g} MPa"
        )
        lines.append(f"  {text}")
    if comparison.scatter.any:
        lines.append(f"  {comparison.scatter.text}.")
    lines += [f"  left out: {line}" for line in skipped_lines(comparison.skipped, MOST_SKIPPED)]
    lines += [f"  warning: {warning}" for warning in comparison.warnings]
    return "\n".join(lines)
