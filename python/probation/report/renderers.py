"""Which function says, draws or writes which result: one line each.

A result is named by its module and class, a renderer by its module in `probation.report` and its function. Both are
names, so that a summary does not load matplotlib. A result of another package has a class attribute RENDERERS with such
a line, its renderers named by their full module and function.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from collections.abc import Callable

RENDERERS: dict[str, dict[str, str]] = {
    "records.record.Record": {"card": "cards.record_card", "line": "cards.record_line"},
    "records.campaign.Campaign": {"card": "cards.campaign_card", "line": "cards.campaign_line"},
    "law.modal.Law": {"card": "cards.law_card"},
    "identify.result.Fit": {
        "card": "cards.fit_card",
        "line": "cards.fit_line",
        "summary": "fit_summary.fit_summary",
        "plot": "fit_page.fit_figure",
        "corner": "band_figures.corner_figure",
        "report": "fit_page.write_fit_page",
    },
    "identify.band.StressBand": {"plot": "band_figures.band_figure"},
    "certificate.result.Certificate": {
        "card": "cards.certificate_card",
        "line": "cards.certificate_line",
        "summary": "certificate_summary.certificate_summary",
        "plot": "certificate_page.certificate_figure",
        "report": "certificate_page.write_certificate_page",
    },
    "calibration.result.Calibration": {
        "card": "cards.calibration_card",
        "line": "cards.calibration_line",
        "summary": "companion_summary.companion_summary",
        "plot": "companion_figure.companion_figure",
        "report": "companion_page.write_companion_page",
    },
    "smoothing.answer.RecordExcitation": {"plot": "excitation_figures.excitation_figure"},
    "smoothing.answer.ExcitationAnswer": {
        "summary": "excitation_summary.excitation_summary",
        "plot": "excitation_figures.answer_figure",
        "report": "excitation_page.write_excitation_page",
    },
    "simulation.Simulation": {
        "card": "cards.simulation_card",
        "line": "cards.simulation_line",
        "summary": "simulation_summary.simulation_summary",
        "plot": "plots.simulation_plot",
    },
    "schemes.result.CrossCheck": {
        "summary": "crosscheck_summary.crosscheck_summary",
        "plot": "crosscheck_page.crosscheck_figure",
        "report": "crosscheck_page.write_crosscheck_page",
    },
    "diagnosis.result.Diagnosis": {
        "card": "cards.diagnosis_card",
        "line": "cards.diagnosis_line",
        "summary": "diagnosis_summary.summary",
        "plot": "diagnosis_figures.diagnosis_figure",
        "report": "diagnosis_page.write_diagnosis_page",
    },
    "diagnosis.isolability.CampaignIsolability": {
        "summary": "isolability_table.isolability_summary",
        "plot": "isolability_figure.campaign_isolability_figure",
        "report": "isolability_page.write_isolability_page",
    },
    "design.plan.Plan": {
        "verdict": "plan_summary.plan_verdict",
        "summary": "plan_summary.plan_summary",
        "plot": "isolability_figure.plan_figure",
        "report": "isolability_page.write_plan_page",
    },
    "comparison.result.Comparison": {
        "summary": "comparison_summary.comparison_summary",
        "plot": "comparison_page.comparison_figure",
        "report": "comparison_page.write_comparison_page",
    },
    "records.preview.Preview": {"summary": "preview_summary.preview_summary", "plot": "preview_figure.preview_figure"},
    "records.initial.init_campaign.InitialCampaign": {
        "summary": "initial_summary.initial_summary",
        "plot": "initial_page.initial_figure",
        "report": "initial_page.write_initial_page",
    },
    "exporting.result.Export": {"summary": "export_summary.export_summary"},
    "field.maps.FieldMaps": {
        "summary": "field_summary.field_summary",
        "plot": "field_page.field_figure",
        "report": "field_page.write_field_page",
    },
}


FROM_SUMMARY = {"card": "probation.report.cards.summary_card", "line": "probation.report.cards.summary_line"}
"""Of a result that says no more than its summary."""


def renderer(result: type, what: str) -> Callable[..., Any]:
    """The function that makes `what` of results of a class; a class without a line of its own has its parent's.

    Parameters
    ----------
    what : {"summary", "plot", "report", "verdict", "card", "line"}
    """
    for ancestor in result.__mro__:
        name = f"{ancestor.__module__}.{ancestor.__qualname__}".removeprefix("probation.")
        here = {offer: f"probation.report.{function}" for offer, function in RENDERERS.get(name, {}).items()}
        if line := here or vars(ancestor).get("RENDERERS"):
            module, _, function = (FROM_SUMMARY | line)[what].rpartition(".")
            render: Callable[..., Any] = getattr(import_module(module), function)
            return render
    raise LookupError(f"{result.__name__} has no line in probation/report/renderers.py")
