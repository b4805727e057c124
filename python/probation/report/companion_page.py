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
    from collections.abc import Sequence
    from pathlib import Path

    from matplotlib.figure import Figure

    from probation.calibration.result import Calibration

_LEADS = {
    "table": "The longest relaxation time identified at several strain rates, and the relations that follow it.",
    "by-rate": "Each record was fitted alone with a constant τ_max; the relations are regressed on what they gave.",
    "direct": "The strain rate of these records is not constant: the relations were identified on all of them at once, "
    "through the law with α = 1.",
}


def write_companion_page(calibration: Calibration, path: Path) -> None:
    """Write the page."""
    companion_page(calibration, companion_figure(calibration)).write(path)


def companion_page(
    calibration: Calibration, figure: Figure, *, bars: str = "bars of 95 %", further: Sequence[Section] = ()
) -> Page:
    """The page, to which a study may add.

    Parameters
    ----------
    figure : Figure
        What `companion_figure` draws.
    bars : str
        What its error bars are.
    further : sequence of Section
        What stands between the choice of a form and its use.
    """
    sections = [_relations(calibration, figure, bars), _choice(calibration), *further, _use(calibration)]
    if calibration.warnings:
        sections.append(Section("What to know", calibration.warnings))
    return Page(
        title=f"Companion relation of {calibration.source}",
        verdict=calibration.verdict,
        mood="neutral",
        lead=_LEADS[calibration.route],
        sections=tuple(sections),
        provenance=provenance(calibration.data_sha256),
    )


def _relations(calibration: Calibration, figure: Figure, bars: str) -> Section:
    data = f"Points: τ_max identified at each rate; {bars}."
    if calibration.route == "direct":
        data = "Black: what each record's own α makes of the chosen relation, over the rates that it runs through."
    caption = f"τ_max (left) and the Weissenberg number (right) against the strain rate: Figure S2. {data}"
    parts: list[object] = [
        picture(figure, caption),
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
