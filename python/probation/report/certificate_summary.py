"""A certificate in words and tables."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.inference.parameter import SYMBOLS, UNITS
from probation.report.table import Table
from probation.settings.certificate import CERTIFICATE
from probation.wording import plus_minus, times

if TYPE_CHECKING:
    from probation.certificate.consistency import Estimate
    from probation.certificate.result import Certificate


def certificate_summary(certificate: Certificate) -> str:
    """Verdict first, then numbers, then details."""
    parts = [f"{certificate.campaign}: {certificate.headline}"]
    parts += [table.text() for table in tables(certificate)]
    base = certificate.base
    values = ", ".join(
        f"{SYMBOLS[name]} {getattr(base.law, name):.5g} {UNITS[name]}".rstrip() for name in base.law.parameter_names
    )
    ending = f"  identified on {', '.join(base.records)}: {values}; scheme {base.scheme}"
    level = f"  a parameter fails where p is below {CERTIFICATE.significance:.0%}, shared between the parameters (Holm)"
    parts.append("\n".join([ending, level, *(f"  warning: {warning}" for warning in certificate.warnings)]))
    return "\n\n".join(parts)


def tables(certificate: Certificate) -> tuple[Table, ...]:
    """All of them, the most important first."""
    first = (parameter_table(certificate), prediction_table(certificate), identification_table(certificate))
    return (*first, hardening_table(certificate)) if certificate.regressions else first


def parameter_table(certificate: Certificate) -> Table:
    """Every parameter over the records."""
    records = list(certificate.alone)
    rows = []
    for name, parameter in certificate.parameters.items():
        label = f"{SYMBOLS[name]} [{UNITS[name]}]" if UNITS[name] else SYMBOLS[name]
        verdict = "passes" if parameter.passes else "fails"
        if not parameter.tested:
            verdict = "not tested"
        cells = [_estimate(parameter.by_record[record]) for record in records]
        rows.append((label, *cells, _probability(parameter.p_value), verdict))
    return Table(
        ("parameter", *records, "p", "verdict"),
        tuple(rows),
        "Does a parameter keep its value? (± standard error by noise and model bias)",
    )


def prediction_table(certificate: Certificate) -> Table:
    """Every predicted record."""
    rows = tuple(
        (
            prediction.id,
            f"{prediction.rms_MPa:.3g}",
            f"{prediction.max_MPa:.3g}",
            f"{prediction.largest_at['true_strain']:.2g}",
            times(prediction.noise_units),
            f"{prediction.tolerance_MPa:.3g}",
            "within" if prediction.passes else "beyond",
        )
        for prediction in certificate.predictions.values()
    )
    headings = ("record", "rms [MPa]", "largest [MPa]", "at strain", "rms / noise", "tolerance [MPa]", "tolerance?")
    return Table(headings, rows, "Direct prediction, nothing adjusted")


def identification_table(certificate: Certificate) -> Table:
    """Every record identified alone, as the paper's Tables 3 and 4."""
    variants = [
        ("E_u held", certificate.alone),
        ("all free", certificate.free),
        ("constant τ_max", certificate.without_companion),
    ]
    rows = []
    for record in certificate.alone:
        for label, fits in variants:
            if record not in fits:
                continue
            alone = fits[record]
            values = [f"{alone.parameters[name].value:.5g}" for name in alone.law.parameter_names]
            if fits is certificate.without_companion:
                values[1] += " s"
            rows.append((record, label, *values, f"{alone.rms_MPa:.3g}", f"{alone.records[record].max_MPa:.3g}"))
    second = SYMBOLS[certificate.base.law.parameter_names[1]]
    unit = UNITS[certificate.base.law.parameter_names[1]]
    headings = ("record", "identified", "E_u [MPa]", f"{second} [{unit}]" if unit else second, "G [MPa]")
    return Table((*headings, "rms [MPa]", "largest [MPa]"), tuple(rows), "Each record identified alone", left=2)


def hardening_table(certificate: Certificate) -> Table:
    """G by regression, and G identified."""
    rows = tuple(
        (
            record,
            f"{regression.hardening_modulus:.4g}",
            f"{certificate.alone[record].law.hardening_modulus:.4g}",
            f"{regression.r_squared:.4f}",
        )
        for record, regression in certificate.regressions.items()
    )
    return Table(
        ("record", "G by regression [MPa]", "G identified [MPa]", "R²"),
        rows,
        "G as the slope of stress over Haward–Thackray strain beyond a strain of 0.4",
    )


def _estimate(estimate: Estimate) -> str:
    if estimate.total_se is None:
        return f"{estimate.value:.4g}, not determined"
    return plus_minus(estimate.value, estimate.total_se)


def _probability(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-6 else "< 1e-6"
