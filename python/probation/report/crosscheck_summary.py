"""A cross-check of the schemes in words and tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from probation.report.table import Table
from probation.schemes.result import short

if TYPE_CHECKING:
    from probation.schemes.result import CrossCheck, RecordCheck


def crosscheck_summary(found: CrossCheck) -> str:
    """The verdict, one table per record, CVODE's statistics."""
    parts = [found.verdict, f"Law: {found.law}."]
    for record in found.records:
        parts.append("\n".join([record_table(record).text(), *(f"  {note}" for note in notes(record))]))
    return "\n\n".join(parts)


def record_table(record: RecordCheck) -> Table:
    """One row per scheme."""
    rows = tuple(
        (
            each.name,
            short(each.largest_error_MPa) if not each.failure else "failed",
            short(each.rms_error_MPa),
            "–" if math.isnan(each.order) else f"{each.order:.2f}",
            "–" if math.isnan(each.time_us) else f"{each.time_us:.0f}",
        )
        for each in record.schemes
    )
    headings = ("scheme", "largest error [MPa]", "rms [MPa]", "order", "time [µs]")
    caption = f"{record.record}: {record.samples} samples, error against {record.reference}"
    return Table(headings, rows, caption)


def notes(record: RecordCheck) -> list[str]:
    """CVODE's statistics, and why a scheme failed."""
    lines = []
    for each in record.schemes:
        if each.failure:
            lines.append(f"{each.name} failed: {each.failure}")
        elif each.statistics:
            numbers = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in each.statistics.items())
            lines.append(f"{each.name}: {numbers}")
    if record.steps is not None:
        lines.append(
            f"orders observed on a smooth history ({record.steps.history}), steps {record.steps.step[0]:.3g} to "
            f"{record.steps.step[-1]:.3g} s, errors over its last two thirds"
        )
    return lines
