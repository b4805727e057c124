"""A calibration in words and tables, for the terminal and for a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.calibration.cross_validation import percent
from probation.report.table import Table
from probation.wording import percentage, plus_minus

if TYPE_CHECKING:
    from probation.calibration.calibrated import CalibratedCompanion
    from probation.calibration.result import Calibration


def companion_summary(found: Calibration) -> str:
    """Verdict first, then the relations, then the scores, then what should be known about them."""
    tables = [relations_table(found), residuals_table(found), scores_table(found), prediction_table(found)]
    parts = [f"{found.source}: {found.verdict}", *(each.text() for each in tables if each is not None)]
    notes = notes_on(found)
    if found.paper is not None:
        notes += [*found.paper.sentences()]
    if notes:
        parts.append("\n".join(f"  {note}" for note in notes))
    if found.warnings:
        parts.append("\n".join(f"  warning: {warning}" for warning in found.warnings))
    return "\n\n".join(parts)


def relations_table(found: Calibration) -> Table:
    """Every relation with its parameters and their standard errors; R² or rms."""
    rows = []
    for name, each in found.candidates.items():
        marked = f"{name} ←" if name == found.chosen else name
        fit = f"{each.r_squared:.4f} in {each.form.measure}"
        if each.direct is not None:
            fit = f"{np.sqrt(np.mean(each.direct.rms**2)):.4g} MPa rms"
        if each.form.reference and not each.form.parameter_names:
            fit = "–"
        rows.append((marked, parameters_text(each.companion), fit, _scatter_text(each.companion.log_scatter)))
    fit_heading = "fit" if found.route == "direct" else "R²"
    return Table(
        ("form", "parameters ± standard errors", fit_heading, "scatter [%]"),
        tuple(rows),
        "Relations (← chosen)",
        left=2,
    )


def residuals_table(found: Calibration) -> Table | None:
    """tau_max at each rate and the error of every relation there [%]."""
    shown = {n: each for n, each in found.candidates.items() if each.form.parameter_names and n != "constant"}
    rows = []
    if found.table is not None:
        table = found.table
        error = table.log_error
        for at, label in enumerate(table.labels):
            known = "" if error is None else f" ± {percentage(error[at])} %"
            hardening = "–" if table.hardening_modulus is None else f"{table.hardening_modulus[at]:.4g}"
            weissenberg = table.tau_max[at] * table.rates[at]
            rows.append(
                (
                    label,
                    f"{table.rates[at]:.3g}",
                    f"{table.tau_max[at]:.5g}{known}",
                    f"{weissenberg:.4f}",
                    hardening,
                    *(percentage(0.01 * each.percent_residual[at], "+") for each in shown.values()),
                )
            )
        headings = ("", "rate [1/s]", "τ_max [s]", "We", "G [MPa]", *(f"{name} [%]" for name in shown))
        return Table(headings, tuple(rows), "Each rate, and the error of each relation there")
    for at, rate in enumerate(found.record_rates):
        rows.append(
            (
                rate.id,
                f"{rate.slow:.2g}–{rate.fast:.2g}",
                *(percentage(0.01 * e.percent_residual[at], "+") for e in shown.values()),
            )
        )
    headings = ("record", "rates [1/s]", *(f"{name} [%]" for name in shown))
    return Table(headings, tuple(rows), "Each relation over what the record's own α asks for")


def scores_table(found: Calibration) -> Table | None:
    """How well each form predicts rates left out."""
    rows = []
    for name, each in found.candidates.items():
        if each.score is None:
            continue
        kind = "reference" if each.form.reference else "chosen" if name == found.chosen else ""
        errors = ", ".join(percent(error, sign="+") for error in each.score.log_error)
        rms = percent(each.score.rms)
        rows.append((name, kind, rms, errors))
    if not rows:
        return None
    headings = ("form", "", "rms", "each in turn")
    return Table(headings, tuple(rows), "Error in ln τ_max [%] at rates left out of the calibration", left=2)


def prediction_table(found: Calibration) -> Table | None:
    """Records predicted from those at other rates, nothing adjusted [MPa]."""
    if not found.predicted:
        return None
    forms = list(dict.fromkeys(each.form for each in found.predicted))
    rows = []
    for record in dict.fromkeys(each.record for each in found.predicted):
        own = {each.form: each for each in found.predicted if each.record == record}
        cells = [
            f"{own[f].rms:.3g} ({percentage(own[f].rms / own[f].largest_stress)} %)" if f in own else "–" for f in forms
        ]
        best = min(own.values(), key=lambda each: each.rms)
        rows.append(
            (record, *cells, f"{best.hardening_rms:.3g}", f"{best.refit_rms:.3g}", f"{best.largest_stress:.3g}")
        )
    headings = ("record", *forms, "G refitted", "α, G refitted", "largest stress")
    caption = "Records predicted from those at other rates, nothing adjusted: rms [MPa] (of the largest stress)"
    return Table(headings, tuple(rows), caption)


def notes_on(found: Calibration) -> list[str]:
    """What a reader must know to use the numbers."""
    notes = []
    fits, companion = found.record_fits, found.companion
    if fits is not None and fits.unrelaxed_modulus is not None:
        how = "held by the campaign" if fits.unrelaxed_modulus_se == 0.0 else "shared by all records"
        notes.append(
            f"E_u = {plus_minus(fits.unrelaxed_modulus, fits.unrelaxed_modulus_se)} MPa, {how}: the errors of τ_max at "
            "each rate are those at this E_u; the product E_u·τ_max is what is known. The relation's errors include "
            "E_u's."
        )
    elif companion.unrelaxed_modulus is not None:
        direct = found.candidates[found.chosen].direct
        error = 0.0 if direct is None else direct.unrelaxed_modulus_se
        how = "shared by all records" if error else "held by the campaign"
        hardening = "G is each record's own" if found.hardening == "by-record" else "G is one for all"
        notes.append(f"E_u = {plus_minus(companion.unrelaxed_modulus, error)} MPa, {how}; {hardening}; α = 1.")
    if found.check is not None:
        notes.append(check_text(found))
    if found.table is not None and found.table.se is None:
        notes.append("No standard errors given: errors of τ_max are taken as relative and alike at all rates.")
    if found.table is not None and found.table.se is not None and "exponential" not in found.candidates:
        notes.append("exponential (12) is the same function as power, and the same relation where errors are known.")
    return notes


def check_text(found: Calibration) -> str:
    """How far the relation identified on all records at once is from that of the table."""
    check, own = found.check, found.companion
    assert check is not None
    rates = np.geomspace(*(own.relation.calibrated or (1e-4, 1e-2)), 50)
    apart = np.log(check.companion.relaxation_time(rates) * check.unrelaxed_modulus)
    apart = apart - np.log(own.relaxation_time(rates) * (own.unrelaxed_modulus or check.unrelaxed_modulus))
    what = "E_u·τ_max" if own.unrelaxed_modulus is not None else "τ_max"
    return (
        f"All records at once through the law, α = 1: {parameters_text(check.companion)}; {what} differs by at most "
        f"{percentage(float(np.max(np.abs(np.expm1(apart)))))} % over the calibrated rates."
    )


def parameters_text(companion: CalibratedCompanion) -> str:
    """``slope 0.00460 ± 0.00037, intercept 0.0406 ± 0.0012``."""
    errors = companion.standard_errors
    if not companion.form.parameter_names:
        return f"{len(errors)} points"
    pairs = zip(companion.parameter_names, companion.parameters, errors, strict=True)
    return ", ".join(f"{name} {plus_minus(value, error)}" for name, value, error in pairs)


def _scatter_text(scatter: float) -> str:
    return percent(scatter) if scatter > 0.0 else "–"
