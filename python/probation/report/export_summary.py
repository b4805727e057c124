"""An export as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.exporting.source import AS_GIVEN
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.exporting.result import Export


def export_summary(exported: Export) -> str:
    """Where the law comes from and what its fit says of itself, the round trip, then what is left out."""
    first, *others = exported.checks
    lines = [
        f"{exported.what}.",
        f"  round trip: {first.error:.2g} MPa at most, {percentage(first.relative)} % of the largest stress",
    ]
    if exported.request.source != AS_GIVEN:
        lines.insert(1, f"  {exported.request.source}")
    if exported.request.reduction is not None:
        lines.append(f"  {exported.request.reduction.summary()}")
    return "\n".join([*lines, *(f"  {check.text}" for check in others)])
