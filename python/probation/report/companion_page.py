"""A calibration of companion relations as a page."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.provenance import provenance
from probation.report.companion_figure import companion_figure
from probation.report.companion_summary import (
    notes_on,
    prediction_table,
    relations_table,
    residuals_table,
    scores_table,
)
from probation.report.page import Page, Section, picture
from probation.report.table import Table

if TYPE_CHECKING:
    from pathlib import Path

    from probation.calibration.paper_relations import PaperRelations
    from probation.calibration.result import Calibration

_LEADS = {
    "table": "The longest relaxation time identified at several strain rates, and the relations that follow it.",
    "by-rate": "Each record was fitted alone with a constant τ_max; the relations are regressed on what they gave.",
    "direct": "The strain rate of these records is not constant: the relations were identified on all of them at once, "
    "through the law with α = 1.",
}


def write_companion_page(calibration: Calibration, path: Path) -> None:
    """Write the page."""
    sections = [_relations(calibration), _choice(calibration), _use(calibration)]
    if calibration.paper is not None:
        sections.insert(2, _paper(calibration.paper))
    if calibration.warnings:
        sections.append(Section("What to know", calibration.warnings))
    Page(
        title=f"Companion relation of {calibration.source}",
        verdict=calibration.verdict,
        mood="neutral",
        lead=_LEADS[calibration.route],
        sections=tuple(sections),
        provenance=provenance(calibration.data_sha256),
    ).write(path)


def _relations(calibration: Calibration) -> Section:
    bars = "; bars of 10 %, as fictitious as in the paper" if calibration.paper is not None else "; bars of 95 %"
    data = f"Points: τ_max identified at each rate{bars}."
    if calibration.route == "direct":
        data = "Black: what each record's own α makes of the chosen relation, over the rates that it runs through."
    caption = f"τ_max (left) and the Weissenberg number (right) against the strain rate: Figure S2. {data}"
    parts: list[object] = [
        picture(companion_figure(calibration), caption),
        relations_table(calibration),
        residuals_table(calibration),
    ]
    return Section("Relations", tuple(parts) + tuple(notes_on(calibration)))  # type: ignore[arg-type]


def _choice(calibration: Calibration) -> Section:
    scores, predicted = scores_table(calibration), prediction_table(calibration)
    if scores is None:
        return Section("Which form?", ("Too few rates to leave one out: the data do not choose a form.",))
    parts: list[str | Table] = [
        "Each rate in turn is left out, the relation calibrated on the others, and τ_max predicted at the rate left "
        "out. The lowest rms is chosen; references are there to compare with, and never chosen.",
        scores,
    ]
    if predicted is not None:
        parts.append(predicted)
    return Section("Which form?", tuple(parts))


def _paper(paper: PaperRelations) -> Section:
    from probation.calibration.table_2 import TABLE_2  # noqa: PLC0415 - only for this page

    names = tuple(paper.percent)
    rows = [
        (f"{rate:.3g}", f"{time:.5g}", *(f"{paper.percent[name][at]:+.1f}" for name in names))
        for at, (rate, time) in enumerate(zip(TABLE_2.rates, TABLE_2.tau_max, strict=True))
    ]
    slope, intercept = paper.weissenberg.parameters
    coefficient, exponent = paper.exponential.parameters
    errors = paper.weissenberg.covariance
    assert errors is not None
    spread = np.sqrt(np.diag(errors))
    beside = (
        ("(11) slope", "0.00464", f"{slope:.5f} ± {spread[0]:.5f}"),
        ("(11) intercept", "0.0367", f"{intercept:.4f} ± {spread[1]:.4f}"),
        ("(11) R² in We", "0.976", f"{paper.weissenberg.r_squared:.3f}"),
        ("(12) coefficient [s]", "27.24", f"{coefficient:.2f}"),
        ("(12) exponent", "−2.1", f"{exponent:.3f}"),
        ("(12) R² in τ_max", "1", f"{paper.exponential.r_squared:.5f}"),
    )
    ratios = tuple(
        (
            f"experiment {ratio.experiment}",
            f"{ratio.printed:.3f}",
            f"{ratio.as_printed:.3f}",
            f"{ratio.as_regressed:.3f}",
        )
        for ratio in paper.ratios
    )
    return Section(
        "The paper's own relations",
        (
            Table(("", "as printed", "regressed from Table 2"), beside),
            Table(("rate [1/s]", "τ_max [s]", *(f"{name} [%]" for name in names)), tuple(rows), "Errors on Table 2"),
            Table(
                ("α with (11) over α with (12)", "Tables 3, 4", "synthetic, 0.0367", "synthetic, regressed"),
                ratios,
                "Which intercept were Tables 3 and 4 computed with?",
            ),
            *paper.sentences(),
        ),
    )


def _use(calibration: Calibration) -> Section:
    low, high = calibration.companion.relation.calibrated or (np.nan, np.nan)
    lines = calibration.toml().splitlines()
    rows = tuple((line.split(" = ")[0], _shortened(line.split(" = ", 1)[-1])) for line in lines[1:])
    return Section(
        "To use it",
        (
            f"It holds between {low:.2g} and {high:.2g} 1/s. Beyond, its form is assumed: the standard error grows "
            "with the distance, but knows nothing of other forms. What probation companion --toml prints, in full "
            "precision, goes into campaign.toml:",
            Table(("[law.companion]", ""), rows, left=2),
        ),
    )


def _shortened(value: str) -> str:
    """Numbers to six digits, for reading."""
    if value.startswith("[["):
        return "… as printed by --toml"
    if value.startswith("["):
        return ", ".join(f"{float(entry):.4g}" for entry in value.strip("[]").split(","))
    try:
        return f"{float(value):.6g}"
    except ValueError:
        return value
