"""A coverage study in words and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.identify.coverage import TRUTH
from probation.inference.parameter import SYMBOLS
from probation.report.table import Table

if TYPE_CHECKING:
    from probation.identify.coverage import Coverage


def coverage_summary(found: Coverage) -> str:
    """Verdict and table."""
    note = "✗: the exact 99 % binomial interval of the coverage does not contain 95 %."
    return f"{found.verdict}\n\n{coverage_table(found).text()}\n\n  {note} Seed {found.seed}."


def coverage_table(found: Coverage) -> Table:
    """Coverage in percent with its exact 99 % interval, and bias of E_u, per case and method."""
    names = list(TRUTH)
    rows = []
    for each in found.counted:
        cells = []
        for name in names:
            low, high = each.interval(name)
            mark = "" if each.holds(name) else " ✗"
            cells.append(f"{100 * each.coverage(name):.1f} [{100 * low:.1f}, {100 * high:.1f}]{mark}")
        rows.append((each.case, each.method, str(each.draws), *cells, f"{100 * each.bias[names[0]]:+.2f}"))
    headings = ("noise", "weighting", "draws", *(f"{SYMBOLS[name]} [%]" for name in names), "bias of E_u [%]")
    return Table(headings, tuple(rows), left=2)
