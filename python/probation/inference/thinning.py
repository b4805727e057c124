"""Records that hold more samples than a diagnosis can use."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.records.campaign import Campaign
    from probation.records.record import Record


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
            record = _every(record, step)  # noqa: PLW2901
        records.append(record)
    return replace(campaign, records=tuple(records)), tuple(notes)


def _every(record: Record, step: int) -> Record:
    def taken(values: FloatArray | None) -> FloatArray | None:
        return None if values is None else values[::step]

    return replace(
        record,
        time=record.time[::step],
        true_strain=record.true_strain[::step],
        true_stress=record.true_stress[::step],
        strain_rate=taken(record.strain_rate),
        transverse_strain=taken(record.transverse_strain),
        temperature=taken(record.temperature),
    )
