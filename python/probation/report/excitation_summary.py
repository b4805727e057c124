"""The excitation of records in words and tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.report.table import Table
from probation.settings.smoothing import SMOOTHING
from probation.wording import percentage, plus_minus

if TYPE_CHECKING:
    from probation.smoothing.answer import ExcitationAnswer, RecordExcitation


def excitation_summary(answer: ExcitationAnswer) -> str:
    """A verdict per record, then a table and warnings for each."""
    parts = ["\n".join(record.verdict for record in answer.records)]
    for record in answer.records:
        title = [record.id] if len(answer.records) > 1 else []
        parts.append(
            "\n".join([*title, facts_table(record).text(), *(f"  warning: {text}" for text in record.warnings)])
        )
    return "\n\n".join(parts)


def facts_table(answer: RecordExcitation) -> Table:
    """The facts as a table."""
    return Table(("quantity", "value"), facts_of(answer), left=2)


def facts_of(answer: RecordExcitation) -> tuple[tuple[str, str], ...]:
    """Quantity and value, as text."""
    facts = answer.facts
    known = "given with the record" if facts["strain_noise_given"] else "estimated"
    rate, strain = facts["strain_rate_per_s"], facts["true_strain"]
    errors = [percentage(error) for error in facts["relative_se_of_rate"].values()]
    rows = [
        ("method", f"{facts['method']}: {facts['differentiator']}"),
        ("samples", f"{facts['samples']}, described with {facts['degrees_of_freedom']:.3g} degrees of freedom"),
        ("strain noise", f"{facts['strain_noise']:.2g}, {known}{_correlation(facts['noise_inflation'])}"),
        ("strain", f"{strain['first']:.4g} … {strain['last']:.4g}, standard error {facts['median_se_of_strain']:.2g}"),
        ("rate at the start", f"{plus_minus(rate['first'], rate['se_of_first'])} 1/s"),
        ("rate at the end", f"{plus_minus(rate['last'], rate['se_of_last'])} 1/s"),
        ("its standard error", "median {}, 95 % below {}, largest {} %".format(*errors)),
    ]
    if not facts["rate_is_that_of_the_scheme"]:
        off = facts["integrated_rate_minus_measured_strain"]
        rows.append(("integrated rate − measured strain", f"{off:.2g} at most"))
    if steps := facts.get("two_steps"):
        own, off = steps["rate"], steps["rate"]["integrated_minus_measured_strain"]
        rows += [
            ("(A-1) leaves", f"{steps['strain']['rms_after_step_1']:.2g} (rms of the strain)"),
            ("sines", f"{len(steps['strain']['sines_Hz'])} leave {steps['strain']['rms_after_step_2']:.2g}"),
            ("the rate's own fit", f"{len(own['sines_Hz'])} sines; integrated {off:.2g} off"),
        ]
    return tuple(rows)


def _correlation(grown: float) -> str:
    return "" if grown <= SMOOTHING.correlated else f", correlated from sample to sample (×{grown:.2g})"
