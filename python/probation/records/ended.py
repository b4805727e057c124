"""A record that ends earlier than its file does, and the sentence that says why."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation.records.record import Record


def ended(record: Record, end: int, why: str) -> tuple[Record, str]:
    """The record up to a sample, without it, and a sentence on that; as it is, and no words, where it has no more.

    Parameters
    ----------
    end : int
        How many samples are kept.
    why : str
        May name the ``{time}`` of the first sample that is left out [s], and the ``{strain}`` from there on, a median.
    """
    if end == len(record):
        return record, ""
    said = why.format(time=record.time[end], strain=np.median(record.true_strain[end:]))
    return record.only(slice(end)), f"{said}; the {len(record) - end} samples from there on were left out"
