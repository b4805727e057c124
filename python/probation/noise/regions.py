"""Regions of records: in time, strain, strain rate and phase; runs of samples."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation.noise.record_residual import RecordResidual

Kind = Literal["time", "strain", "rate", "phase", "record"]

PHASES = {1.0: "loading", 0.0: "dwell", -1.0: "unloading"}


@dataclass(frozen=True, eq=False)
class Region:
    """Samples of one or of several records that are looked at together.

    Attributes
    ----------
    kind : {"time", "strain", "rate", "phase", "record"}
    label : str
        In words.
    members : tuple of (int, ndarray of bool)
        Record index and which of its samples.
    """

    kind: Kind
    label: str
    members: tuple[tuple[int, NDArray[np.bool_]], ...]


def time_regions(records: Sequence[RecordResidual]) -> list[Region]:
    """Every record whole, halved, quartered ...; the finer ones also shifted by half their length."""
    regions = []
    for index, record in enumerate(records):
        count = len(record)
        pieces = 1
        while pieces <= NOISE.finest_region and count // pieces >= NOISE.fewest_of_a_region:
            shifts = (0.0, 0.5) if pieces >= 4 else (0.0,)
            for shift in shifts:
                borders = ((np.arange(pieces + 1 - (shift > 0)) + shift) * count / pieces).round().astype(int)
                for first, stop in pairwise(borders):
                    inside = np.zeros(count, dtype=bool)
                    inside[first:stop] = True
                    ends = record.time[first], record.time[stop - 1]
                    label = f"{record.name}, {ends[0]:.4g} to {ends[1]:.4g} s"
                    regions.append(Region("record" if pieces == 1 else "time", label, ((index, inside),)))
            pieces *= 2
    return regions


def state_regions(records: Sequence[RecordResidual]) -> list[Region]:
    """Parts of the strain range, decades of the rate, and loading, dwell and unloading, over all records together."""
    regions = []
    strain = [record.true_strain for record in records]
    ends = np.linspace(min(s.min() for s in strain), max(s.max() for s in strain), NOISE.strain_regions + 1)
    for low, high in pairwise(ends):
        inside = [(s >= low) & ((s < high) | (high == ends[-1])) for s in strain]
        regions += _region("strain", f"true strain {low:.3g} to {high:.3g}", inside)
    phases = [record.phase for record in records]
    if len(np.unique(np.concatenate(phases))) > 1:
        for sign, label in PHASES.items():
            regions += _region("phase", label, [phase == sign for phase in phases])
    with np.errstate(divide="ignore"):
        logs = [np.log10(np.abs(record.strain_rate)) for record in records]
    moving = np.concatenate([log[phase != 0.0] for log, phase in zip(logs, phases, strict=True)])
    if moving.size:
        low, high = np.quantile(moving, NOISE.rate_ends)
        pieces = int(min(np.ceil(high - low), NOISE.most_rate_regions)) if high - low > NOISE.least_rate_range else 1
        borders = np.linspace(low, high, pieces + 1)
        for first, last in pairwise(borders):
            inside = [
                (phase != 0.0) & ((log >= first) | (first == borders[0])) & ((log < last) | (last == borders[-1]))
                for log, phase in zip(logs, phases, strict=True)
            ]
            if pieces > 1:
                regions += _region("rate", f"strain rate {10.0**first:.2g} to {10.0**last:.2g} 1/s", inside)
    return regions


def _region(kind: Kind, label: str, inside: list[NDArray[np.bool_]]) -> list[Region]:
    members = tuple(
        (index, mask) for index, mask in enumerate(inside) if np.count_nonzero(mask) >= NOISE.fewest_of_a_region
    )
    return [Region(kind, label, members)] if members else []
