"""An export as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.exporting.source import AS_GIVEN
from probation.wording import percentage

if TYPE_CHECKING:
    from probation.exporting.result import Export


def export_summary(found: Export) -> str:
    """Where the law comes from and what its fit says of itself, the round trip, then what is left out."""
    first, *others = found.checks
    lines = [
        f"{found.what}.",
        f"  round trip: {first.error:.2g} MPa at most, {percentage(first.relative)} % of the largest stress",
    ]
    if found.request.source != AS_GIVEN:
        lines.insert(1, f"  {found.request.source}")
    if found.request.reduction is not None:
        lines.append(f"  {found.request.reduction.summary()}")
    return "\n".join([*lines, *(f"  {check.text}" for check in others)])
