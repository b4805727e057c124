"""Records as they were tested: what a program, a machine or a logger added when they were written is taken away."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.records.even_times import even_times
from probation.records.until_break import until_break
from probation.records.until_strain_stops import until_strain_stops
from probation.records.without_glitches import without_glitches

if TYPE_CHECKING:
    from probation.records.campaign import Campaign


def as_tested(campaign: Campaign) -> Campaign:
    """The campaign with records without glitches, ended where specimen or extensometer did, at times before rounding.

    Every record that was changed has a warning.

    Parameters
    ----------
    campaign : Campaign
    """
    records = []
    for record in campaign.records:
        notes = []
        for step in (without_glitches, until_break, until_strain_stops, even_times):
            record, note = step(record)  # noqa: PLW2901
            notes += [note] if note else []
        records.append(replace(record, warnings=(*record.warnings, *notes)) if notes else record)
    changed = any(new is not old for new, old in zip(records, campaign.records, strict=True))
    return replace(campaign, records=tuple(records)) if changed else campaign
