"""A fit as a figure and as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from probation.inference.parameter import SYMBOLS, Parameter
from probation.provenance import provenance
from probation.report.fit_summary import estimate_text, noise_text
from probation.report.page import Page, Section, picture
from probation.report.plots import Curve, sensitivities, strain_rates, stress_strain_with_residuals
from probation.report.residual_plots import profile_figure, residual_parts
from probation.report.table import Table

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.figure import Figure

    from probation.identify.record_fit import RecordFit
    from probation.identify.result import Fit


def fit_figure(fit: Fit) -> Figure:
    """Stress over strain, measured and identified, with the fit residuals below: the paper's Figure 2."""
    return stress_strain_with_residuals([_curve(fit, record) for record in fit.records.values()], title=fit.campaign)


def sensitivity_figure(fit: Fit, record: RecordFit) -> Figure:
    """Scaled sensitivities of one record: parameter times derivative of the stress."""
    scaled = record.sensitivity * fit.law.parameters
    return sensitivities(record.true_strain, scaled, [SYMBOLS[name] for name in fit.law.parameter_names])


def write_fit_page(fit: Fit, path: Path) -> None:
    """Write the page."""
    good = fit.bias_MPa <= fit.noise_MPa
    poor = any(p.status not in ("identifiable", "held") for p in fit.parameters.values())
    Page(
        title=f"Identification of {fit.campaign}",
        verdict=fit.verdict,
        mood="good" if good and not poor else "bad" if poor else "neutral",
        lead="The modal law, eq. (6), identified on the records below, which share its parameters.",
        sections=(_parameters(fit), _records(fit), *_profiles(fit), _sensitivities(fit), _how(fit)),
        provenance=provenance(fit.data_sha256),
    ).write(path)


def _curve(fit: Fit, record: RecordFit) -> Curve:
    reach = float(stdtrit(fit.degrees, 0.975)) * np.hypot(fit.stress_error(record.sensitivity), record.rms_MPa)
    band = reach if np.all(np.isfinite(reach)) else None
    return Curve(record.id, record.true_strain, record.true_stress, record.model_stress, record.noise_MPa, band)


def _parameters(fit: Fit) -> Section:
    second = SYMBOLS[fit.law.parameter_names[1]]
    rows = [_row(SYMBOLS[name], parameter) for name, parameter in fit.parameters.items()]
    rows.append(_row(f"E_u·{second}", fit.product))
    parts: list[str | Table] = [
        Table(("parameter", "unit", "estimate ± standard error", "status"), tuple(rows), left=4)
    ]
    if len(fit.names) > 1:
        symbols = tuple(SYMBOLS[name] for name in fit.names)
        matrix = tuple(
            (symbol, *(f"{value:+.3f}" for value in row)) for symbol, row in zip(symbols, fit.correlation, strict=True)
        )
        parts.append(Table(("correlation", *symbols), matrix))
    parts.append(
        f"E_u and {second} are strongly correlated in a tension test; their product is known far better than either. "
        f"The condition number of the scaled Jacobian is {fit.condition_number:.3g}."
    )
    return Section("Parameters", tuple(parts))


def _row(symbol: str, parameter: Parameter) -> tuple[str, str, str, str]:
    return symbol, parameter.unit or "–", estimate_text(parameter), parameter.status.replace("_", " ")


def _records(fit: Fit) -> Section:
    rows = tuple(
        (
            record.id,
            record.excitation.differentiator,
            f"{record.rms_MPa:.4g}",
            f"{record.max_MPa:.4g}",
            f"{record.noise_MPa:.4g}",
            f"{record.bias_MPa:.4g}",
            f"{record.bias.largest_MPa:.3g} at {record.bias.true_strain:.3g}" if record.bias.significant else "–",
        )
        for record in fit.records.values()
    )
    headings = (
        "record",
        "strain rate by",
        "rms [MPa]",
        "largest [MPa]",
        "noise [MPa]",
        "bias [MPa]",
        "largest bias [MPa] at strain",
    )
    rates = strain_rates([(r.id, r.excitation.true_strain, r.excitation.rate) for r in fit.records.values()])
    return Section(
        "What is left",
        (
            picture(fit_figure(fit), "Measured and identified true stress; below, the fit residual, model minus data."),
            Table(headings, rows, left=2),
            "Noise is the part of the fit residual that changes from sample to sample; bias is the rest: what the law, "
            "or the experiment, leaves out. Its largest value is that of the low-frequency part, a parabola moved over "
            "a twelfth of the record, where that stands out of the noise.",
            *(
                picture(residual_parts(record), f"Record {record.id}: the fit residual and its low-frequency part.")
                for record in fit.records.values()
            ),
            picture(rates, "The strain rate that drove the law."),
        ),
    )


def _profiles(fit: Fit) -> tuple[Section, ...]:
    if not fit.profiles:
        return ()
    text = (
        "The cost rises as one parameter moves and the others follow. A straight line means that the standard error "
        "says it all; where it bends, the interval of the profile is the better one."
    )
    shown = picture(profile_figure(fit), "Signed root of the profile likelihood, with the 95 % interval.")
    return (Section("Profile likelihood", (shown, text)),)


def _sensitivities(fit: Fit) -> Section:
    pictures = tuple(
        picture(sensitivity_figure(fit, record), f"Record {record.id}: what each parameter does to the stress.")
        for record in fit.records.values()
    )
    return Section("Sensitivities", pictures)


def _how(fit: Fit) -> Section:
    noise = noise_text(fit)
    text = (
        f"Method {fit.method}; scheme {fit.scheme} with {fit.substeps} steps from sample to sample, start {fit.start}; "
        f"{fit.law.spectrum.modal_weight.size if fit.law.spectrum else fit.law.modes} modes. "
        f"{noise[0].upper()}{noise[1:]}."
    )
    shift = ", ".join(f"{SYMBOLS[name]} {moved:+.2g}" for name, moved in fit.scheme_shift.items())
    scheme = (
        f"The scheme's own error is at most {fit.scheme_error_MPa:.2g} MPa; in standard errors it shifts {shift}."
        if fit.scheme_shift
        else ""
    )
    return Section("How it was done", tuple(part for part in (text, scheme, *fit.warnings) if part))
