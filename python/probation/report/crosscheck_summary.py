"""A cross-check of the schemes in words and tables."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from probation.report.table import Table
from probation.schemes.result import short

if TYPE_CHECKING:
    from probation.schemes.result import CrossCheck, RecordCheck


def crosscheck_summary(crosscheck: CrossCheck) -> str:
    """The verdict, one table per record, CVODE's statistics."""
    parts = [crosscheck.verdict, f"Law: {crosscheck.law}."]
    for record in crosscheck.records:
        parts.append("\n".join([record_table(record).text(), *(f"  {note}" for note in notes(record))]))
    return "\n\n".join(parts)


def record_table(record: RecordCheck) -> Table:
    """One row per scheme."""
    rows = tuple(
        (
            scheme.name,
            short(scheme.largest_error_MPa) if not scheme.failure else "failed",
            short(scheme.rms_error_MPa),
            "–" if math.isnan(scheme.order) else f"{scheme.order:.2f}",
            "–" if math.isnan(scheme.time_us) else f"{scheme.time_us:.0f}",
        )
        for scheme in record.schemes
    )
    headings = ("scheme", "largest error [MPa]", "rms [MPa]", "order", "time [µs]")
    caption = f"{record.record}: {record.samples} samples, error against {record.reference}"
    return Table(headings, rows, caption)


def notes(record: RecordCheck) -> list[str]:
    """CVODE's statistics, and why a scheme failed."""
    lines = []
    for scheme in record.schemes:
        if scheme.failure:
            lines.append(f"{scheme.name} failed: {scheme.failure}")
        elif scheme.statistics:
            numbers = ", ".join(f"{name.replace('_', ' ')} {count}" for name, count in scheme.statistics.items())
            lines.append(f"{scheme.name}: {numbers}")
    if record.steps is not None:
        lines.append(
            f"orders observed on a smooth history ({record.steps.history}), steps {record.steps.step[0]:.3g} to "
            f"{record.steps.step[-1]:.3g} s, errors over its last two thirds"
        )
    return lines
