"""What a notebook shows of records, campaigns, laws and results, and the one line that `repr` gives."""

from __future__ import annotations

from itertools import islice
from typing import TYPE_CHECKING, Any

from probation.errors import InputError
from probation.inference.parameter import SYMBOLS, UNITS
from probation.report.card import MOST_CURVES, Card, Drawing, colours, shortened
from probation.report.certificate_summary import parameter_table, prediction_table
from probation.report.diagnosis_tables import base_table, where_table, which_table
from probation.report.fit_summary import estimate_text
from probation.report.table import Table
from probation.results.rendering import rendered
from probation.wording import plus_minus, within_width

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation._arrays import FloatArray
    from probation.calibration.result import Calibration
    from probation.certificate.result import Certificate
    from probation.diagnosis.result import Diagnosis
    from probation.identify.result import Fit
    from probation.law.modal import Law
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.simulation import Simulation

MOST_ROWS = 6
"""Of a table on a card."""

MOST_NOTES = 5
"""Warnings on a card."""

_LEGEND = (("measured", "data"), ("model", "model"))

_LONGEST = 100
"""Characters of a line before its verdict is cut."""


def record_line(record: Record) -> str:
    """Samples, span and role."""
    return (
        f"<Record {record.id!r}: {len(record)} samples, {record.time[0]:.4g} … {record.time[-1]:.4g} s, "
        f"true strain up to {record.true_strain.max():.3g}, true stress up to {record.true_stress.max():.3g} MPa, "
        f"{record.role}>"
    )


def record_card(record: Record) -> Card:
    """Span, noise and source of a record, and its curve."""
    rows = [
        ("samples", str(len(record)), ""),
        ("time", f"{record.time[0]:.5g} … {record.time[-1]:.5g}", "s"),
        ("true strain", f"{record.true_strain.min():.4g} … {record.true_strain.max():.4g}", "–"),
        ("true stress", f"{record.true_stress.min():.4g} … {record.true_stress.max():.4g}", "MPa"),
        ("control", record.control, ""),
        ("role", record.role, ""),
    ]
    if record.specimen_id is not None:
        rows.append(("specimen", record.specimen_id, ""))
    if record.file is not None:
        rows.append(("file", record.file.name, ""))
    return Card(
        kind="Record",
        title=record.id,
        verdict=f"{len(record)} samples over {record.time[-1] - record.time[0]:.4g} s",
        tables=(Table(("quantity", "value", "unit"), tuple(rows), left=3),),
        drawing=Drawing(((record.true_strain, record.true_stress, "data"),)),
        notes=shortened(record.warnings, MOST_NOTES, "warning"),
    )


def campaign_line(campaign: Campaign) -> str:
    """How many records, and for what."""
    return f"<Campaign {campaign.name!r}: {_how_many(campaign)}>"


def campaign_card(campaign: Campaign) -> Card:
    """Every record in a row, all curves in one drawing."""
    rows = tuple(
        (
            record.id,
            record.role,
            record.control,
            str(len(record)),
            f"{record.time[-1] - record.time[0]:.4g}",
            f"{record.true_strain.max():.3g}",
            f"{record.true_stress.max():.3g}",
        )
        for record in campaign.records
    )
    headings = ("record", "role", "control", "samples", "duration [s]", "largest strain [–]", "largest stress [MPa]")
    shown = campaign.records[:MOST_CURVES]
    curves = zip(shown, colours(len(shown)), strict=True)
    return Card(
        kind="Campaign",
        title=campaign.name,
        verdict=_how_many(campaign),
        tables=(Table(headings, _first(rows), left=3),),
        drawing=Drawing(tuple((record.true_strain, record.true_stress, colour) for record, colour in curves)),
        notes=shortened(campaign.warnings, MOST_NOTES, "warning"),
    )


def law_card(law: Law) -> Card:
    """Parameters and modes of a law."""
    rows = tuple((SYMBOLS[name], f"{getattr(law, name):.6g}", UNITS[name] or "–") for name in law.parameter_names)
    relation = "a constant τ_max" if law.companion is None else repr(law.companion)
    return Card(
        kind="Law",
        title="modal law, eq. (6)",
        verdict=f"{law.modes} modes over {law.decades:g} decades, {relation}",
        tables=(Table(("parameter", "value", "unit"), rows),),
    )


def simulation_line(simulation: Simulation) -> str:
    """What was simulated, and how far it goes."""
    return (
        f"<Simulation of {simulation.name!r} by {simulation.scheme}: {len(simulation.time)} samples, "
        f"true strain up to {simulation.true_strain.max():.3g}, "
        f"true stress up to {simulation.true_stress.max():.3g} MPa>"
    )


def simulation_card(simulation: Simulation) -> Card:
    """The law, and the curve that it gives."""
    law = law_card(simulation.law)
    return Card(
        kind="Simulation",
        title=simulation.name,
        verdict=f"{len(simulation.time)} samples by {simulation.scheme}; "
        f"true stress up to {simulation.true_stress.max():.4g} MPa",
        tables=law.tables,
        drawing=Drawing(((simulation.true_strain, simulation.true_stress, "model"),)),
        notes=(law.verdict, *simulation.warnings),
    )


def fit_line(fit: Fit) -> str:
    """Parameters and what is left."""
    values = ", ".join(_value(SYMBOLS[name], p.value, p.se, p.unit) for name, p in fit.parameters.items())
    return f"<Fit of {fit.campaign!r}: {values}; residual {fit.rms_MPa:.3g} MPa>"


def fit_card(fit: Fit) -> Card:
    """Parameters, records, and the law with what was measured."""
    rows = tuple(
        (SYMBOLS[name], p.unit or "–", estimate_text(p), p.status.replace("_", " "))
        for name, p in fit.parameters.items()
    )
    records = tuple(
        (record.id, f"{record.rms_MPa:.3g}", f"{record.noise_MPa:.3g}", f"{record.bias_MPa:.3g}")
        for record in fit.records.values()
    )
    poor = any(p.status not in ("identifiable", "held") for p in fit.parameters.values())
    return Card(
        kind="Fit",
        title=fit.campaign,
        verdict=fit.verdict,
        mood="bad" if poor else "good" if fit.bias_MPa <= fit.noise_MPa else "neutral",
        tables=(
            Table(("parameter", "unit", "estimate ± standard error", "status"), rows, left=4),
            Table(("record", "rms [MPa]", "noise [MPa]", "bias [MPa]"), _first(records)),
        ),
        drawing=_drawn(
            (record.true_strain, record.true_stress, record.model_stress) for record in fit.records.values()
        ),
        notes=shortened(fit.warnings, MOST_NOTES, "warning"),
    )


def certificate_line(certificate: Certificate) -> str:
    """The verdict."""
    return _line("Certificate", certificate.campaign, certificate.headline)


def certificate_card(certificate: Certificate) -> Card:
    """The verdict, what passes, and the predictions."""
    return Card(
        kind="Certificate",
        title=certificate.campaign,
        verdict=certificate.headline,
        mood={"intrinsic": "good", "not_intrinsic": "bad"}.get(certificate.verdict, "neutral"),  # type: ignore[arg-type]
        tables=(parameter_table(certificate), prediction_table(certificate)),
        drawing=_drawn(
            (prediction.true_strain, prediction.true_stress, prediction.model_stress)
            for prediction in certificate.predictions.values()
        ),
        notes=shortened(certificate.warnings, MOST_NOTES, "warning"),
    )


def diagnosis_line(diagnosis: Diagnosis) -> str:
    """The headline."""
    return _line("Diagnosis", diagnosis.campaign, diagnosis.headline)


def diagnosis_card(diagnosis: Diagnosis) -> Card:
    """The headline, the causes, and where the gap is."""
    which, _ = which_table(diagnosis, MOST_ROWS)
    where, _ = where_table(diagnosis, MOST_ROWS)
    return Card(
        kind="Diagnosis",
        title=diagnosis.campaign,
        verdict=diagnosis.headline,
        mood={"no_gap": "good", "explained": "neutral"}.get(diagnosis.verdict, "bad"),  # type: ignore[arg-type]
        tables=(base_table(diagnosis),) if diagnosis.verdict == "no_gap" else (which, where),
        drawing=_drawn((curves.true_strain, curves.data, curves.base) for curves in diagnosis.curves.values()),
        notes=shortened(diagnosis.warnings, MOST_NOTES, "warning"),
    )


def calibration_line(calibration: Calibration) -> str:
    """The relation."""
    return _line("Calibration", calibration.source, calibration.verdict)


def calibration_card(calibration: Calibration) -> Card:
    """The relation and its rivals."""
    chosen = calibration.candidates[calibration.chosen]
    known = chosen.companion
    rows = tuple(
        (name, plus_minus(float(value), float(error)))
        for name, value, error in zip(known.parameter_names, known.parameters, known.standard_errors, strict=True)
    )
    rivals = tuple(
        (candidate.form.title, "–" if candidate.score is None else f"{100.0 * candidate.score.rms:.2g}")
        for candidate in calibration.candidates.values()
    )
    return Card(
        kind="Calibration",
        title=calibration.source,
        verdict=calibration.verdict,
        tables=(
            Table(("parameter", "value ± standard error"), rows, chosen.form.title),
            Table(("form", "error at rates left out [%]"), _first(rivals)),
        ),
        notes=shortened(calibration.warnings, MOST_NOTES, "warning"),
    )


def summary_line(result: Any) -> str:
    """The first line of its summary."""
    return _line(type(result).__name__, "", rendered(result, "summary").splitlines()[0])


def summary_card(result: Any) -> Card:
    """The first line of its summary, and the rest to unfold."""
    first, _, rest = rendered(result, "summary").partition("\n")
    return Card(kind=type(result).__name__, title="", verdict=first, details=within_width(rest.strip("\n")))


def _line(kind: str, title: str, verdict: str) -> str:
    said = " ".join(verdict.split())
    said = said if len(said) <= _LONGEST else said[:_LONGEST].rsplit(" ", 1)[0] + " …"
    return f"<{kind}{f' of {title!r}' if title else ''}: {said}>"


def _value(symbol: str, value: float, error: float | None, unit: str) -> str:
    number = f"{value:.5g}" if error is None else plus_minus(value, error)
    return f"{symbol} = {number} {unit}".rstrip()


def _how_many(campaign: Campaign) -> str:
    count, held_out = len(campaign.records), len(campaign.held_out)
    records = f"{count} record{'s' if count > 1 else ''}"
    if not held_out:
        return f"{records} to identify on"
    return f"{records}, {count - held_out} to identify on and {held_out} held out"


def _first(rows: tuple[tuple[str, ...], ...]) -> tuple[tuple[str, ...], ...]:
    """At most so many rows; the last says how many there are."""
    if len(rows) <= MOST_ROWS:
        return rows
    blank = ("",) * (len(rows[0]) - 1)
    return (*rows[: MOST_ROWS - 1], (f"… and {len(rows) - MOST_ROWS + 1} more", *blank))


def _drawn(curves: Iterable[tuple[FloatArray, FloatArray, FloatArray]]) -> Drawing | None:
    """Strain, measured and model stress of records: measured in grey, the model's on top.

    None for what was read from JSON without curves.
    """
    try:
        shown = list(islice(curves, MOST_CURVES))
    except InputError:
        return None
    measured = [(strain, stress, "data") for strain, stress, _ in shown]
    return Drawing((*measured, *((strain, model, "model") for strain, _, model in shown)), _LEGEND)
