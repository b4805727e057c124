"""Ripples: a gap that is periodic in the strain. Serrated flow, a neck that sticks and slips, a wavy scale."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import gammaincc

from probation.gap.sharp import NEIGHBOURS, SLOWEST, left_beside_slow_waves, running_median, uneven_power

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.gap.whitening import Whitened

OVERSAMPLING = 2
SHORTEST = 8
"""Samples per period, on the average, of the shortest ripple that is looked for."""


@dataclass(frozen=True)
class Ripple:
    """The strongest ripple of a record, or of all together.

    Attributes
    ----------
    record : str or None
        None for all.
    period_strain : float
    p_value : float
        Over all periods of all records.
    """

    record: str | None
    period_strain: float
    p_value: float


def find_ripples(whitened: Whitened) -> tuple[Ripple, ...]:
    """The strongest part of every record, and of all together, that is periodic in the recorded strain, by p-value.

    As `gap.sharp.find_lines`, over the strain: where the strain rate changes, teeth of one pitch are no line in time.
    What is a material's has one period in all records, so that their powers add up.

    Parameters
    ----------
    whitened : Whitened
    """
    extents = [float(np.ptp(record.true_strain)) for record in whitened.records]
    longest = max(extents)
    seen = [
        index
        for index, record in enumerate(whitened.records)
        if len(record) >= 8 * SLOWEST and extents[index] > 0.3 * longest > 0.0
    ]
    if not seen:
        return ()
    most = max(len(whitened.records[index]) for index in seen)
    frequency = np.arange(OVERSAMPLING * SLOWEST // 2, OVERSAMPLING * most // SHORTEST) / (OVERSAMPLING * longest)
    families = len(seen) + 1
    found, together, added = [], np.zeros(len(frequency)), np.zeros(len(frequency))
    for index in seen:
        record = whitened.records[index]
        left, _ = left_beside_slow_waves(whitened, index, SLOWEST)
        power = uneven_power(record.true_strain, left, frequency)
        level = np.maximum(running_median(power, NEIGHBOURS) / np.log(2.0), 1.0)
        power = power / level
        resolved = (frequency * extents[index] >= 0.5 * SLOWEST) & (
            frequency * extents[index] * SHORTEST <= len(record)
        )
        together, added = together + np.where(resolved, power, 0.0), added + resolved
        found.append(_strongest(record.name, frequency[resolved], np.exp(-power[resolved]), families))
    if len(seen) > 1:
        found.append(_strongest(None, frequency, gammaincc(np.maximum(added, 1.0), together), families))
    return tuple(sorted(found, key=lambda ripple: ripple.p_value))


def _strongest(record: str | None, frequency: FloatArray, chances: FloatArray, families: int) -> Ripple:
    """The least of the chances of as much power at each frequency, among all frequencies of so many families."""
    if not chances.size:
        return Ripple(record, np.inf, 1.0)
    best = int(np.argmin(chances))
    tried = chances.size * families
    p_value = float(-np.expm1(tried * np.log1p(-min(float(chances[best]), 1.0 - 1e-15))))
    return Ripple(record, 1.0 / float(frequency[best]), p_value)
