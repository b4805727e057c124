"""Gaps that recur at one strain in every record: a neck that passes, a band, a scale that errs at one place."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.gap.sharp import SLOWEST, left_beside_slow_waves
from probation.gap.tail import normal_tail

if TYPE_CHECKING:
    from probation.gap.whitening import Whitened

WIDTHS = (0.03, 0.06)
"""Standard deviations of the bumps that are looked for, as parts of the largest strain."""

FEWEST = 3
"""Samples within a bump's standard deviation that a record needs to be asked."""

MOST_LIKE_NOISE = 1.4826
"""Standard deviations of a normal number in its median absolute value."""


@dataclass(frozen=True)
class Recurring:
    """The strongest bump that all records share at one strain.

    Attributes
    ----------
    true_strain : float
        Its middle.
    width_strain : float
        Its standard deviation.
    records : tuple of str
        That reach there.
    p_value : float
        Over all places and widths.
    """

    true_strain: float
    width_strain: float
    records: tuple[str, ...]
    p_value: float


def find_recurring(whitened: Whitened) -> tuple[Recurring, ...]:
    """Bumps at one strain that several records share, strongest first.

    What each record's residual holds of a bump, slow waves and its own refit projected out, is added up over the
    records and held against what is found at other strains: a noise whose colour or level is taken wrongly is the
    same everywhere, but what a material does at one strain it does in every test.

    Parameters
    ----------
    whitened : Whitened
    """
    if len(whitened.records) < 2:
        return ()
    largest = max(float(record.true_strain.max()) for record in whitened.records)
    found = []
    for part in WIDTHS:
        width = part * largest
        places = np.arange(width, largest, width)
        along, power = np.zeros(len(places)), np.zeros(len(places))
        seen = np.zeros((len(whitened.records), len(places)), dtype=bool)
        for index, record in enumerate(whitened.records):
            if len(record) < 8 * SLOWEST:
                continue
            away = (record.true_strain[:, None] - places) / width
            seen[index] = np.count_nonzero(np.abs(away) < 1.0, axis=0) >= FEWEST
            if not seen[index].any():
                continue
            left, white = left_beside_slow_waves(whitened, index, SLOWEST)
            bumps = whitened.noises[index].whiten(np.exp(-0.5 * away[:, seen[index]] ** 2))
            bumps -= white @ (white.T @ bumps)
            along[seen[index]] += bumps.T @ left
            power[seen[index]] += np.sum(bumps**2, axis=0)
        shared = np.flatnonzero(np.count_nonzero(seen, axis=0) >= 2)
        if not shared.size:
            continue
        scores = along[shared] / np.sqrt(np.maximum(power[shared], 1e-300))
        usual = max(MOST_LIKE_NOISE * float(np.median(np.abs(scores))), 1.0)
        at = int(np.argmax(np.abs(scores)))
        tried = len(WIDTHS) * len(shared)
        single = 2.0 * float(normal_tail(abs(scores[at]) / usual, 0.0))
        names = tuple(record.name for record, there in zip(whitened.records, seen[:, shared[at]], strict=True) if there)
        p_value = float(-np.expm1(tried * np.log1p(-min(single, 1.0 - 1e-15))))
        found.append(Recurring(float(places[shared[at]]), width, names, p_value))
    return tuple(sorted(found, key=lambda each: each.p_value))
