"""An export as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.wording import percentage

if TYPE_CHECKING:
    from probation.exporting.result import Export


def export_summary(exported: Export) -> str:
    """The round trip first, then what is left out."""
    first, *others = exported.checks
    lines = [
        f"{exported.what}.",
        f"  round trip: {first.error:.2g} MPa at most, {percentage(first.relative)} % of the largest stress",
    ]
    if exported.request.reduction is not None:
        lines.append(f"  {exported.request.reduction.summary()}")
    return "\n".join([*lines, *(f"  {check.text}" for check in others)])
