"""A certificate as figures and as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.parameter import SYMBOLS, UNITS
from probation.law.kinematics import haward_thackray_strain
from probation.normal import TWO_SIDED_95
from probation.provenance import provenance
from probation.report.certificate_summary import (
    hardening_table,
    identification_table,
    parameter_table,
    prediction_table,
)
from probation.report.figures import styled_figure, thinned
from probation.report.page import Page, Section, picture
from probation.report.plots import strain_rates
from probation.report.style import colour, series_colour
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from probation._arrays import FloatArray
    from probation.certificate.result import Certificate

_DOTS = 250  # measured points that are drawn

_MOOD = {"intrinsic": "good", "intrinsic_except": "neutral", "not_intrinsic": "bad"}


def certificate_figure(certificate: Certificate) -> Figure:
    """Every record over strain: measured, predicted with nothing adjusted, identified alone; beside it the errors.

    The paper's Figures 4 to 6.
    """
    records = list(certificate.alone)
    with styled_figure(7.6, 0.5 + 2.3 * len(records)) as figure:
        panels = figure.subplots(len(records), 2, squeeze=False, width_ratios=(1.25, 1), sharex=True)
        for (left, right), record in zip(panels, records, strict=True):
            _record(left, right, certificate, record)
        for axes in panels[-1]:
            axes.set_xlabel("true strain [–]")
    return figure


def _record(left: Axes, right: Axes, certificate: Certificate, record: str) -> None:
    alone = certificate.alone[record].records[record]
    strain, stress = alone.true_strain, alone.true_stress
    left.plot(*thinned(strain, stress, _DOTS), ".", ms=4, mew=0, color=colour("data"), label="measured")
    lines: list[tuple[str, FloatArray, str]] = []
    if record in certificate.predictions:
        lines.append(("predicted, nothing adjusted", certificate.predictions[record].model_stress, colour("second")))
    if record in certificate.base.records:
        lines.append(("identified together", certificate.base.records[record].model_stress, colour("third")))
    lines.append(("identified alone", alone.model_stress, colour("model")))
    for label, model, shade in lines:
        left.plot(*thinned(strain, model), color=shade, lw=1.1, label=label)
        right.plot(*thinned(strain, model - stress), color=shade, lw=0.9)
    tolerance = certificate.tolerance * float(np.max(np.abs(stress)))
    right.axhspan(-tolerance, tolerance, color=colour("data"), alpha=0.15, lw=0)
    right.axhline(0.0, color=colour("muted"), lw=0.8)
    note = f"band: ±{tolerance:.2g} MPa"
    right.set_title(note, loc="right", fontsize=8, fontweight="normal", color=colour("muted"))  # curves fill the axes
    left.set_title(record)
    left.set_ylabel("true stress [MPa]")
    right.set_ylabel("model − measured [MPa]")
    left.legend(loc="best", fontsize=7.5)


def parameter_figure(certificate: Certificate) -> Figure:
    """Every parameter over the records, with 95 % intervals: a law that is intrinsic keeps them level."""
    shown = {
        name: [(record, e.value, e.total_se) for record, e in parameter.by_record.items() if e.total_se is not None]
        for name, parameter in certificate.parameters.items()
    }
    shown = {name: entries for name, entries in shown.items() if entries}
    with styled_figure(7.6, 0.7 + 0.24 * sum(len(entries) for entries in shown.values()) + 0.6 * len(shown)) as figure:
        panels = figure.subplots(len(shown), 1, squeeze=False)[:, 0]
        for axes, (name, entries) in zip(panels, shown.items(), strict=True):
            certified = certificate.parameters[name]
            good = not certified.tested or certified.passes
            for at, (_, value, error) in enumerate(entries):
                shade = colour("model" if good else "bad")
                axes.errorbar(
                    value, at, xerr=TWO_SIDED_95 * (error or 0.0), fmt="o", ms=4, capsize=3, lw=1.2, color=shade
                )
            if good:  # values that differ have no common one
                axes.axvline(certified.mean, color=colour("muted"), lw=0.8)
            axes.set_yticks(range(len(entries)), [record for record, *_ in entries])
            axes.set_ylim(len(entries) - 0.5, -0.5)
            axes.grid(axis="y", visible=False)
            label = f"{SYMBOLS[name]} [{UNITS[name]}]" if UNITS[name] else SYMBOLS[name]
            verdict = ("passes" if certified.passes else "does not pass") if certified.tested else "not tested"
            axes.set_title(verdict, color=colour("ink" if good else "bad"))
            axes.set(xlabel=label, ylabel="record")
            axes.ticklabel_format(axis="x", useOffset=False)
    return figure


def without_companion_figure(certificate: Certificate) -> Figure:
    """Every record with a constant tau_max: the paper's Figure 3."""
    with styled_figure(7.6, 3.6) as figure:
        axes = figure.subplots()
        for at, (record, fit) in enumerate(certificate.without_companion.items()):
            entry = fit.records[record]
            measured = thinned(entry.true_strain, entry.true_stress, _DOTS)
            axes.plot(*measured, ".", ms=4, mew=0, color=colour("data"), label="measured" if at == 0 else None)
            label = f"{record}, constant τ_max: {fit.rms_MPa:.2g} MPa rms"
            axes.plot(*thinned(entry.true_strain, entry.model_stress), color=series_colour(at), lw=1.1, label=label)
        axes.set(xlabel="true strain [–]", ylabel="true stress [MPa]")
        axes.legend()
    return figure


def hardening_figure(certificate: Certificate) -> Figure:
    """Stress over Haward-Thackray strain and its regression: the paper's Figure S1."""
    with styled_figure(7.6, 3.6) as figure:
        axes = figure.subplots()
        for at, (record, line) in enumerate(certificate.regressions.items()):
            entry = certificate.alone[record].records[record]
            hardening = haward_thackray_strain(entry.true_strain)
            axes.plot(*thinned(hardening, entry.true_stress, _DOTS), ".", ms=4, mew=0, color=colour("data"))
            ends = haward_thackray_strain(np.array([line.from_strain, float(entry.true_strain.max())]))
            values = line.intercept + line.hardening_modulus * ends
            axes.plot(ends, values, color=series_colour(at), label=f"{record}: G = {line.hardening_modulus:.3g} MPa")
        axes.set(xlabel="Haward–Thackray strain [–]", ylabel="true stress [MPa]")
        axes.legend()
    return figure


def write_certificate_page(certificate: Certificate, path: Path) -> None:
    """Write the page."""
    sections = [_prediction(certificate), _parameters(certificate), _identification(certificate)]
    if certificate.without_companion:
        sections.append(_without_companion(certificate))
    if certificate.regressions:
        sections.append(_hardening(certificate))
    sections.append(_how(certificate))
    Page(
        title=f"Probation test of the law on {certificate.campaign}",
        verdict=certificate.headline,
        mood=_MOOD[certificate.verdict],  # type: ignore[arg-type]
        lead="A law is intrinsic if parameters found on one kind of test predict tests driven quite otherwise. Here "
        f"they are found on {', '.join(certificate.base.records)}.",
        sections=tuple(sections),
        provenance=provenance(certificate.data_sha256),
    ).write(path)


def _prediction(certificate: Certificate) -> Section:
    rates = strain_rates(
        [
            (name, fit.records[name].excitation.true_strain, fit.records[name].excitation.rate)
            for name, fit in certificate.alone.items()
        ]
    )
    return Section(
        "Prediction",
        (
            prediction_table(certificate),
            "The error is judged without the noise: the tolerance is "
            f"{100 * certificate.tolerance:g} % of the largest stress of each record.",
            picture(
                certificate_figure(certificate),
                "Measured, predicted and identified stress, and what they differ by; band: the tolerance.",
            ),
            picture(rates, "What drives the records: strain rate over strain (Figure 1 of the paper)."),
        ),
    )


def _parameters(certificate: Certificate) -> Section:
    return Section(
        "Does every parameter keep its value?",
        (
            parameter_table(certificate),
            "Each record is identified alone, held-out ones too, after the predictions were made. A standard error "
            "holds the noise, the wave that the law leaves behind (taken as a sample of a bias that may also hide "
            "behind the parameters), and the uncertainty of the E_u that is held. p is the chance of values that "
            "differ at least so much if the parameter were the same; a parameter fails below "
            f"{CERTIFICATE.significance:.0%}, shared between the parameters (Holm).",
            picture(
                parameter_figure(certificate),
                "Each parameter over the records, with 95 % intervals; line: their common value, where they have one.",
            ),
        ),
    )


def _identification(certificate: Certificate) -> Section:
    text = (
        "“E_u held” keeps E_u as identified above (identifications 2 and 3 of the paper's Tables 3 and 4); “all free” "
        "is its identification 4. Where those differ much in E_u and hardly in what is left, the record does not tell "
        "E_u from the relaxation times."
    )
    return Section("Each record by itself", (identification_table(certificate), text))


def _without_companion(certificate: Certificate) -> Section:
    worst, fit = max(certificate.without_companion.items(), key=lambda item: item[1].rms_MPa)
    text = (
        f"With one constant τ_max the law leaves up to {fit.rms_MPa:.2g} MPa rms ({worst}). "
        "Where the strain rate changes along a record, E_u may then grow without bound while τ_max shrinks: only their "
        "product is seen."
    )
    figure = picture(
        without_companion_figure(certificate), "The best that a constant τ_max can do (Figure 3 of the paper)."
    )
    return Section("Without the companion relation", (text, figure))


def _hardening(certificate: Certificate) -> Section:
    start = CERTIFICATE.hardening_from
    caption = f"Stress over Haward–Thackray strain and its slope beyond a strain of {start:g} (Figure S1)."
    text = (
        "The regression assumes that all viscous stress stays constant; where it relaxes or grows with the strain rate "
        "the slope differs from the G that the law needs."
    )
    return Section(
        "G by regression", (hardening_table(certificate), text, picture(hardening_figure(certificate), caption))
    )


def _how(certificate: Certificate) -> Section:
    base = certificate.base
    companion = base.law.companion
    relation = f"companion relation {companion}" if companion else "no companion relation: τ_max is a constant"
    steps = f"{base.substeps} steps from sample to sample"
    return Section(
        "How it was done",
        (
            f"Scheme {base.scheme}, {steps}, start {base.start}; {base.law.modes} modes; {relation}.",
            *certificate.warnings,
        ),
    )
