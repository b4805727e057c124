"""A coverage study in words and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.parameter import SYMBOLS
from probation.report.table import Table
from probation_studies.coverage.study import TRUTH

if TYPE_CHECKING:
    from probation_studies.coverage.study import Coverage


def coverage_summary(coverage: Coverage) -> str:
    """Verdict and table."""
    note = "✗: the exact 99 % binomial interval of the coverage does not contain 95 %."
    return f"{coverage.verdict}\n\n{coverage_table(coverage).text()}\n\n  {note} Seed {coverage.seed}."


def coverage_table(coverage: Coverage) -> Table:
    """Coverage in percent with its exact 99 % interval, and bias of E_u, per case and method."""
    names = list(TRUTH)
    rows = []
    for counted_case in coverage.counted:
        cells = []
        for name in names:
            low, high = counted_case.interval(name)
            mark = "" if counted_case.holds(name) else " ✗"
            cells.append(f"{100 * counted_case.coverage(name):.1f} [{100 * low:.1f}, {100 * high:.1f}]{mark}")
        rows.append(
            (
                counted_case.case,
                counted_case.method,
                str(counted_case.draws),
                *cells,
                f"{100 * counted_case.bias[names[0]]:+.2f}",
            )
        )
    headings = ("noise", "weighting", "draws", *(f"{SYMBOLS[name]} [%]" for name in names), "bias of E_u [%]")
    return Table(headings, tuple(rows), left=2)
