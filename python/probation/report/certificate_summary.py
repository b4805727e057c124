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


def certificate_summary(found: Certificate) -> str:
    """Verdict first, then numbers, then details."""
    parts = [f"{found.campaign}: {found.headline}"]
    parts += [table.text() for table in tables(found)]
    base = found.base
    values = ", ".join(
        f"{SYMBOLS[name]} {getattr(base.law, name):.5g} {UNITS[name]}".rstrip() for name in base.law.parameter_names
    )
    ending = f"  identified on {', '.join(base.records)}: {values}; scheme {base.scheme}"
    level = f"  a parameter fails where p is below {CERTIFICATE.significance:.0%}, shared between the parameters (Holm)"
    parts.append("\n".join([ending, level, *(f"  warning: {warning}" for warning in found.warnings)]))
    return "\n\n".join(parts)


def tables(found: Certificate) -> tuple[Table, ...]:
    """All of them, the most important first."""
    first = (parameter_table(found), prediction_table(found), identification_table(found))
    return (*first, hardening_table(found)) if found.regressions else first


def parameter_table(found: Certificate) -> Table:
    """Every parameter over the records."""
    records = list(found.alone)
    rows = []
    for name, each in found.parameters.items():
        label = f"{SYMBOLS[name]} [{UNITS[name]}]" if UNITS[name] else SYMBOLS[name]
        verdict = "passes" if each.passes else "fails"
        if not each.tested:
            verdict = "not tested"
        cells = [_estimate(each.by_record[record]) for record in records]
        rows.append((label, *cells, _probability(each.p_value), verdict))
    return Table(
        ("parameter", *records, "p", "verdict"),
        tuple(rows),
        "Does a parameter keep its value? (± standard error by noise and model bias)",
    )


def prediction_table(found: Certificate) -> Table:
    """Every predicted record."""
    rows = tuple(
        (
            each.id,
            f"{each.rms_MPa:.3g}",
            f"{each.max_MPa:.3g}",
            f"{each.largest_at['true_strain']:.2g}",
            times(each.noise_units),
            f"{each.tolerance_MPa:.3g}",
            "within" if each.passes else "beyond",
        )
        for each in found.predictions.values()
    )
    headings = ("record", "rms [MPa]", "largest [MPa]", "at strain", "rms / noise", "tolerance [MPa]", "tolerance?")
    return Table(headings, rows, "Direct prediction, nothing adjusted")


def identification_table(found: Certificate) -> Table:
    """Every record identified alone, as the paper's Tables 3 and 4."""
    variants = [("E_u held", found.alone), ("all free", found.free), ("constant τ_max", found.without_companion)]
    rows = []
    for record in found.alone:
        for label, fits in variants:
            if record not in fits:
                continue
            alone = fits[record]
            values = [f"{alone.parameters[name].value:.5g}" for name in alone.law.parameter_names]
            if fits is found.without_companion:
                values[1] += " s"
            rows.append((record, label, *values, f"{alone.rms_MPa:.3g}", f"{alone.records[record].max_MPa:.3g}"))
    second = SYMBOLS[found.base.law.parameter_names[1]]
    unit = UNITS[found.base.law.parameter_names[1]]
    headings = ("record", "identified", "E_u [MPa]", f"{second} [{unit}]" if unit else second, "G [MPa]")
    return Table((*headings, "rms [MPa]", "largest [MPa]"), tuple(rows), "Each record identified alone", left=2)


def hardening_table(found: Certificate) -> Table:
    """G by regression, and G identified."""
    rows = tuple(
        (
            record,
            f"{each.hardening_modulus:.4g}",
            f"{found.alone[record].law.hardening_modulus:.4g}",
            f"{each.r_squared:.4f}",
        )
        for record, each in found.regressions.items()
    )
    return Table(
        ("record", "G by regression [MPa]", "G identified [MPa]", "R²"),
        rows,
        "G as the slope of stress over Haward–Thackray strain beyond a strain of 0.4",
    )


def _estimate(found: Estimate) -> str:
    if found.total_se is None:
        return f"{found.value:.4g}, not determined"
    return plus_minus(found.value, found.total_se)


def _probability(value: float) -> str:
    return f"{value:.2g}" if value >= 1e-6 else "< 1e-6"
