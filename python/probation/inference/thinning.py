"""Records that hold more samples than a diagnosis can use."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from probation.records.campaign import Campaign


def thin(campaign: Campaign) -> tuple[Campaign, tuple[str, ...]]:
    """The campaign with every so many-th sample of its long records, and a sentence on each of them.

    Parameters
    ----------
    campaign : Campaign
    """
    records, notes = [], []
    for record in campaign.records:
        step = -(-len(record.time) // SEARCH.most_samples)
        if step > 1:
            notes.append(f"{record.id}: one of every {step} of its {len(record.time)} samples was used")
            record = record.only(slice(None, None, step))  # noqa: PLW2901
        records.append(record)
    return replace(campaign, records=tuple(records)), tuple(notes)
