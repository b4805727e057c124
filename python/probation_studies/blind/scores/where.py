"""Whether the right place was named."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from probation_studies.blind.scores.answer import Region

if TYPE_CHECKING:
    from collections.abc import Mapping


def overlap(one: Sequence[Region], other: Sequence[Region], durations: Mapping[str, float]) -> float:
    """Intersection over union of two sets of regions; each record's time counts as a part of its duration.

    0 where both are empty.
    """
    common = whole = 0.0
    for record, duration in durations.items():
        first = _merged([region for region in one if region.record == record])
        second = _merged([region for region in other if region.record == record])
        shared = sum(
            max(min(a_end, b_end) - max(a_start, b_start), 0.0) for a_start, a_end in first for b_start, b_end in second
        )
        both = sum(end - start for start, end in (*first, *second))
        common += shared / duration
        whole += (both - shared) / duration
    return common / whole if whole > 0.0 else 0.0


def _merged(regions: Sequence[Region]) -> list[tuple[float, float]]:
    """Regions of one record without overlaps."""
    merged: list[tuple[float, float]] = []
    for region in sorted(regions, key=lambda each: each.start):
        if merged and region.start <= merged[-1][1]:
            merged[-1] = merged[-1][0], max(merged[-1][1], region.end)
        else:
            merged.append((region.start, max(region.start, region.end)))
    return merged
