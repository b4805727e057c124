"""Times that a program rounded when it wrote them, of samples that were taken at even steps."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.records.record import Record

STEPS = tuple(float(f"{digit}e{power}") for power in range(1, -7, -1) for digit in (6, 5, 2, 1))
"""Steps that times are rounded to [s], coarsest first; a tenth of a minute is one of them."""

COARSE = 0.05
"""Part of the median sampling interval from which on such a step matters."""

ROUNDING = 1e-6
"""Part of a step that a multiple of it may be off."""

SEVERAL = 5
"""Sampling intervals that are a step longer than others, and shorter, at least: one may be a row that is missing."""


def even_times(record: Record) -> tuple[Record, str]:
    """The record with its times as they were before they were rounded, and a sentence on that.

    As it is, and no words, unless all times are multiples of a step that is coarse for the sampling interval, and even
    times, rounded to that step, are these.
    """
    time = record.time
    intervals = np.diff(time)
    usual = float(np.median(intervals)) * (1.0 + ROUNDING)
    coarse = [step for step in STEPS if COARSE * usual <= step <= usual and _multiples(time, step)]
    if not coarse:
        return record, ""
    step = coarse[0]
    steps = np.round(intervals / step)
    if min(np.count_nonzero(steps == steps.min()), np.count_nonzero(steps > steps.min())) < SEVERAL:
        return record, ""
    even = _even(time, step)
    if even is None:
        return record, ""
    note = (
        f"its times are rounded to {step:g} s; even steps of {even[1] - even[0]:.6g} s, which were rounded so, were "
        "taken in their place"
    )
    return replace(record, time=even), note


def _multiples(time: FloatArray, step: float) -> bool:
    count = time / step
    return bool(np.max(np.abs(count - np.round(count))) < ROUNDING + 1e-14 * np.max(np.abs(count)))


def _even(time: FloatArray, step: float) -> FloatArray | None:
    """Even times within half a step of these; None where there are none. The first is a time as it is, mostly zero."""
    index = np.arange(len(time))
    with np.errstate(divide="ignore"):
        most = np.min((time[1:] - time[0] + 0.5 * step) / index[1:])
        least = np.max((time[1:] - time[0] - 0.5 * step) / index[1:])
    if least > most * (1.0 + ROUNDING):
        return None
    return np.asarray(time[0] + 0.5 * (least + most) * index)
