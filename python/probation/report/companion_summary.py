"""A calibration in words and tables, for the terminal and for a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.calibration.cross_validation import percent
from probation.report.table import Table
from probation.wording import percentage, plus_minus

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.calibration.calibrated import CalibratedCompanion
    from probation.calibration.result import Calibration


def companion_summary(calibration: Calibration, further: Sequence[str] = ()) -> str:
    """Verdict first, then the relations, then the scores, then what should be known about them, `further` last."""
    tables = [
        relations_table(calibration),
        residuals_table(calibration),
        scores_table(calibration),
        prediction_table(calibration),
    ]
    parts = [f"{calibration.source}: {calibration.verdict}", *(table.text() for table in tables if table is not None)]
    if notes := [*notes_on(calibration), *further]:
        parts.append("\n".join(f"  {note}" for note in notes))
    if calibration.warnings:
        parts.append("\n".join(f"  warning: {warning}" for warning in calibration.warnings))
    return "\n\n".join(parts)


def relations_table(calibration: Calibration) -> Table:
    """Every relation with its parameters and their standard errors; R² or rms."""
    rows = []
    for name, candidate in calibration.candidates.items():
        marked = f"{name} ←" if name == calibration.chosen else name
        fit = f"{candidate.r_squared:.4f} in {candidate.form.measure}"
        if candidate.direct is not None:
            fit = f"{np.sqrt(np.mean(candidate.direct.rms**2)):.4g} MPa rms"
        if candidate.form.reference and not candidate.form.parameter_names:
            fit = "–"
        rows.append((marked, parameters_text(candidate.companion), fit, _scatter_text(candidate.companion.log_scatter)))
    fit_heading = "fit" if calibration.route == "direct" else "R²"
    return Table(
        ("form", "parameters ± standard errors", fit_heading, "scatter [%]"),
        tuple(rows),
        "Relations (← chosen)",
        left=2,
    )


def residuals_table(calibration: Calibration) -> Table | None:
    """tau_max at each rate and the error of every relation there [%]."""
    shown = {
        n: candidate
        for n, candidate in calibration.candidates.items()
        if candidate.form.parameter_names and n != "constant"
    }
    rows = []
    if calibration.table is not None:
        table = calibration.table
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
                    *(percentage(0.01 * candidate.percent_residual[at], "+") for candidate in shown.values()),
                )
            )
        headings = ("", "rate [1/s]", "τ_max [s]", "We", "G [MPa]", *(f"{name} [%]" for name in shown))
        return Table(headings, tuple(rows), "Each rate, and the error of each relation there")
    for at, rate in enumerate(calibration.record_rates):
        rows.append(
            (
                rate.id,
                f"{rate.slow:.2g}–{rate.fast:.2g}",
                *(percentage(0.01 * e.percent_residual[at], "+") for e in shown.values()),
            )
        )
    headings = ("record", "rates [1/s]", *(f"{name} [%]" for name in shown))
    return Table(headings, tuple(rows), "Each relation over what the record's own α asks for")


def scores_table(calibration: Calibration) -> Table | None:
    """How well each form predicts rates left out."""
    rows = []
    for name, candidate in calibration.candidates.items():
        if candidate.score is None:
            continue
        kind = "reference" if candidate.form.reference else "chosen" if name == calibration.chosen else ""
        errors = ", ".join(percent(error, sign="+") for error in candidate.score.log_error)
        rms = percent(candidate.score.rms)
        rows.append((name, kind, rms, errors))
    if not rows:
        return None
    headings = ("form", "", "rms", "each in turn")
    return Table(headings, tuple(rows), "Error in ln τ_max [%] at rates left out of the calibration", left=2)


def prediction_table(calibration: Calibration) -> Table | None:
    """Records predicted from those at other rates, nothing adjusted [MPa]."""
    if not calibration.predicted:
        return None
    forms = list(dict.fromkeys(prediction.form for prediction in calibration.predicted))
    rows = []
    for record in dict.fromkeys(prediction.record for prediction in calibration.predicted):
        own = {prediction.form: prediction for prediction in calibration.predicted if prediction.record == record}
        cells = [
            f"{own[f].rms:.3g} ({percentage(own[f].rms / own[f].largest_stress)} %)" if f in own else "–" for f in forms
        ]
        best = min(own.values(), key=lambda prediction: prediction.rms)
        rows.append(
            (record, *cells, f"{best.hardening_rms:.3g}", f"{best.refit_rms:.3g}", f"{best.largest_stress:.3g}")
        )
    headings = ("record", *forms, "G refitted", "α, G refitted", "largest stress")
    caption = "Records predicted from those at other rates, nothing adjusted: rms [MPa] (of the largest stress)"
    return Table(headings, tuple(rows), caption)


def notes_on(calibration: Calibration) -> list[str]:
    """What a reader must know to use the numbers."""
    notes = []
    fits, companion = calibration.record_fits, calibration.companion
    if fits is not None and fits.unrelaxed_modulus is not None:
        how = "held by the campaign" if fits.unrelaxed_modulus_se == 0.0 else "shared by all records"
        notes.append(
            f"E_u = {plus_minus(fits.unrelaxed_modulus, fits.unrelaxed_modulus_se)} MPa, {how}: the errors of τ_max at "
            "each rate are those at this E_u; the product E_u·τ_max is what is known. The relation's errors include "
            "E_u's."
        )
    elif companion.unrelaxed_modulus is not None:
        direct = calibration.candidates[calibration.chosen].direct
        error = 0.0 if direct is None else direct.unrelaxed_modulus_se
        how = "shared by all records" if error else "held by the campaign"
        hardening = "G is each record's own" if calibration.hardening == "by-record" else "G is one for all"
        notes.append(f"E_u = {plus_minus(companion.unrelaxed_modulus, error)} MPa, {how}; {hardening}; α = 1.")
    if calibration.check is not None:
        notes.append(check_text(calibration))
    if calibration.table is not None and calibration.table.se is None:
        notes.append("No standard errors given: errors of τ_max are taken as relative and alike at all rates.")
    if (
        calibration.table is not None
        and calibration.table.se is not None
        and "exponential" not in calibration.candidates
    ):
        notes.append("exponential (12) is the same function as power, and the same relation where errors are known.")
    return notes


def check_text(calibration: Calibration) -> str:
    """How far the relation identified on all records at once is from that of the table."""
    check, own = calibration.check, calibration.companion
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
