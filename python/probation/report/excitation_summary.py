"""The excitation of records, and a comparison of methods, in words and tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.report.table import Table
from probation.settings.smoothing import SMOOTHING
from probation.smoothing.answer import spread
from probation.smoothing.comparison import Closeness
from probation.wording import percentage, plus_minus

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation.smoothing.answer import ExcitationAnswer, RecordExcitation
    from probation.smoothing.comparison import Comparison


def excitation_summary(answer: ExcitationAnswer) -> str:
    """A verdict per record, then a table and warnings for each."""
    parts = ["\n".join(each.verdict for each in answer.records)]
    for each in answer.records:
        title = [each.id] if len(answer.records) > 1 else []
        parts.append("\n".join([*title, facts_table(each).text(), *(f"  warning: {text}" for text in each.warnings)]))
    return "\n\n".join(parts)


def facts_table(answer: RecordExcitation) -> Table:
    """The facts as a table."""
    return Table(("quantity", "value"), facts(answer), left=2)


def facts(answer: RecordExcitation) -> tuple[tuple[str, str], ...]:
    """Quantity and value, as text."""
    excitation = answer.excitation
    known = "given with the record" if answer.record.noise.strain is not None else "estimated"
    rate, strain = excitation.rate, excitation.true_strain
    parts = [percentage(each) for each in spread(answer.relative_error)]
    rows = [
        ("method", f"{excitation.method}: {excitation.differentiator}"),
        ("samples", f"{len(answer.time)}, described with {excitation.freedom:.3g} degrees of freedom"),
        ("strain noise", f"{excitation.strain_noise:.2g}, {known}{_correlation(answer)}"),
        ("strain", f"{strain[0]:.4g} … {strain[-1]:.4g}, standard error {np.median(excitation.strain_se):.2g}"),
        ("rate at the start", f"{plus_minus(rate[0], excitation.rate_se[0])} 1/s"),
        ("rate at the end", f"{plus_minus(rate[-1], excitation.rate_se[-1])} 1/s"),
        ("its standard error", "median {}, 95 % below {}, largest {} %".format(*parts)),
        ("integrated rate − measured strain", f"{np.abs(answer.integrated - answer.measured).max():.2g} at most"),
    ]
    if excitation.strain_rate is None:
        rows[-1:] = []
    if answer.necking is not None:
        fit = answer.necking
        rows += [
            ("(A-1) leaves", f"{np.std(fit.strain.first_residual):.2g} (rms of the strain)"),
            ("sines", f"{len(fit.strain.sines.frequencies)} leave {np.std(fit.strain.final_residual):.2g}"),
            (
                "the rate's own fit",
                f"{len(fit.rate.sines.frequencies)} sines; integrated {fit.largest_drift:.2g} off",
            ),
        ]
    return tuple(rows)


def _correlation(answer: RecordExcitation) -> str:
    grown = answer.excitation.noise_inflation
    return "" if grown <= SMOOTHING.correlated else f", correlated from sample to sample (×{grown:.2g})"


def comparison_summary(found: Comparison) -> str:
    """Verdict, then a table of errors, then one of coverage."""
    return "\n\n".join([found.verdict, errors_table(found).text(), coverage_table(found).text()])


def errors_table(found: Comparison) -> Table:
    """p95 and, in brackets, median of the relative error in percent."""
    return _table(
        found,
        f"p95 (median) of the relative error of the rate [%], mean of {found.draws} draws, seed {found.seed}",
        lambda each: f"{_digits(100 * each.p95)} ({_digits(100 * each.median)})",
    )


def coverage_table(found: Comparison) -> Table:
    """How often the 95 % band holds the truth."""
    return _table(
        found, "samples whose true rate lies within 1.96 standard errors [%]", lambda each: f"{100 * each.coverage:.0f}"
    )


def _table(found: Comparison, caption: str, cell: Callable[[Closeness], str]) -> Table:
    rows = []
    for history in dict.fromkeys(key[0] for key in found.results):
        for noise in found.noises:
            row = [history, f"{noise:g}"]
            for method in found.methods:
                each = found.results[history, noise, method]
                row.append("–" if isinstance(each, str) else cell(each))
            rows.append(tuple(row))
    return Table(("history", "noise", *found.methods), tuple(rows), caption)


def _digits(percent: float) -> str:
    return f"{percent:.2f}" if percent < 10.0 else f"{percent:.0f}"
