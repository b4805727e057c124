"""A comparison of methods in words and tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.table import Table

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation_studies.smoothing.comparison import Closeness, Comparison


def comparison_summary(comparison: Comparison) -> str:
    """Verdict, then a table of errors, then one of coverage."""
    return "\n\n".join([comparison.verdict, errors_table(comparison).text(), coverage_table(comparison).text()])


def errors_table(comparison: Comparison) -> Table:
    """p95 and, in brackets, median of the relative error in percent."""
    return _table(
        comparison,
        f"p95 (median) of the relative error of the rate [%], mean of {comparison.draws} draws, seed {comparison.seed}",
        lambda closeness: f"{_digits(100 * closeness.p95)} ({_digits(100 * closeness.median)})",
    )


def coverage_table(comparison: Comparison) -> Table:
    """How often the 95 % band holds the truth."""
    return _table(
        comparison,
        "samples whose true rate lies within 1.96 standard errors [%]",
        lambda closeness: f"{100 * closeness.coverage:.0f}",
    )


def _table(comparison: Comparison, caption: str, cell: Callable[[Closeness], str]) -> Table:
    rows = []
    for history in dict.fromkeys(key[0] for key in comparison.results):
        for noise in comparison.noises:
            row = [history, f"{noise:g}"]
            for method in comparison.methods:
                each = comparison.results[history, noise, method]
                row.append("–" if isinstance(each, str) else cell(each))
            rows.append(tuple(row))
    return Table(("history", "noise", *comparison.methods), tuple(rows), caption)


def _digits(percent: float) -> str:
    return f"{percent:.2f}" if percent < 10.0 else f"{percent:.0f}"
