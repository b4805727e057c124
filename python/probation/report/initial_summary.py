"""A campaign that was made of files, as text."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation._text import printable
from probation.records.said_once import of_all
from probation.records.text_plot import text_plot
from probation.report.table import Table

if TYPE_CHECKING:
    from collections.abc import Collection

    from probation.records.initial.init_campaign import InitialCampaign
    from probation.records.record import Record

_HEIGHT = 6  # lines of a plot
_PLOTTED = 8  # records; the page has them all


def initial_summary(made: InitialCampaign) -> str:
    """What was written, a table of the records, a plot of each, and what to do next."""
    records = made.campaign.records
    count = "1 record" if len(records) == 1 else f"{len(records)} records"
    parts = [f"{printable(str(made.folder))}: a campaign of {count}", record_table(made).text()]
    common = of_all(records)
    if common:
        parts.append("\n".join(["all records", *(f"  note: {text}" for text in common)]))
    parts += [_described(record, common) for record in records[:_PLOTTED]]
    if len(records) > _PLOTTED:
        parts.append(f"and {len(records) - _PLOTTED} more records: their plots are in records.html")
    parts.append(
        "look at records.html and campaign.toml there, then:\n"
        f"  probation fit {printable(str(made.folder))} --report fit.html"
    )
    return "\n\n".join(parts)


def record_table(made: InitialCampaign) -> Table:
    """Each record: what read it, how it was driven, how long, how far."""
    rows = tuple(
        (
            printable(record.id),
            record.profile,
            record.control if record.role == "identify" else f"{record.control}\n(held-out)",
            f"{record.time[-1] - record.time[0]:.4g}",
            f"{record.true_strain.max():.3g}",
            f"{record.true_stress.max():.4g}",
        )
        for record in made.campaign.records
    )
    headings = ("record", "profile", "control", "time [s]", "strain", "stress [MPa]")
    return Table(headings, rows, left=3)


def _described(record: Record, common: Collection[str]) -> str:
    notes = [f"  note: {warning}" for warning in record.warnings if warning not in common]
    plot = text_plot(record.true_strain, record.true_stress, "true strain [–]", "true stress [MPa]", height=_HEIGHT)
    return "\n".join([f"{record.id}", *notes, plot])
