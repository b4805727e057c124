"""What a gap can look like where nothing is known of it: slow waves along a record, and transients after each jump."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class SmoothBasis:
    """Columns, the smoothest first.

    Attributes
    ----------
    columns : ndarray, shape (n, m)
    order : ndarray of int, shape (m,)
        Half periods, or what a transient counts as; increasing.
    """

    columns: FloatArray
    order: NDArray[np.intp]


def waves(count: int, most: int, time: FloatArray | None = None) -> FloatArray:
    """Cosine waves, shape (count, min(most, count)): orthonormal (DCT-II) by sample, or of the same size in time."""
    index = np.arange(count) + 0.5
    if time is not None:
        index = 0.5 + (count - 1) * (time - time[0]) / (time[-1] - time[0])
    columns = np.cos(np.pi / count * np.outer(index, np.arange(min(most, count)))) * np.sqrt(2.0 / count)
    columns[:, 0] *= np.sqrt(0.5)
    return np.asarray(columns, dtype=np.float64)


def smooth_basis(time: FloatArray, jumps: Sequence[int] = (), most: int = NOISE.smooth_waves) -> SmoothBasis:
    """Slow waves by sample, and exponential fades after the start and after every rate discontinuity.

    Waves follow nothing sharp; a law's error after a jump is sharp and its place is known, so it has its own columns.
    Never more columns than a quarter of the samples.

    Parameters
    ----------
    time : ndarray, shape (n,) [s]
    jumps : sequence of int
    most : int
        Waves.
    """
    count = len(time)
    allowed = max(count // 4, 1)
    parts = [waves(count, min(most, allowed))]
    orders = [np.arange(parts[0].shape[1])]
    borders = [0, *sorted(jumps), count - 1]
    segments = sorted(pairwise(borders), key=lambda ends: ends[0] - ends[1])[: NOISE.transient_segments]
    for first, last in sorted(segments):
        if last - first < NOISE.fewest_for_a_transient:
            continue
        since = (time[first : last + 1] - time[first]) / (time[last] - time[first])
        for constant, order in NOISE.transient_times:
            if order < most:
                fade = np.zeros(count)
                fade[first : last + 1] = np.exp(-since / constant)
                parts.append(fade[:, None] / np.linalg.norm(fade))
                orders.append(np.array([order]))
    columns, ranks = np.hstack(parts), np.concatenate(orders)
    ranking = np.argsort(ranks, kind="stable")[:allowed]
    return SmoothBasis(columns[:, ranking], ranks[ranking])
