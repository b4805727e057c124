"""The linear map from measured strain to the strain and rate that a smoother makes of it, at fixed smoothness."""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Operators:
    """What the samples do to strain and rate.

    Attributes
    ----------
    strain : ndarray, shape (n_used, n_measured) [-]
        d strain used / d strain measured.
    rate : ndarray, shape (n_used, n_measured) [1/s]
        d rate used / d strain measured.
    """

    strain: FloatArray
    rate: FloatArray


def joined(blocks: Sequence[Operators], jumps: Sequence[int], n_times: int) -> Operators:
    """Operators of segments that share their borders, as one.

    A jump belongs to both of its segments: its strain is the mean of the two, its rate the one before it.

    Parameters
    ----------
    blocks : sequence of Operators
        One per segment, square.
    jumps : sequence of int
        Indices of the inner borders.
    n_times : int
    """
    strain, rate = np.zeros((n_times, n_times)), np.zeros((n_times, n_times))
    for block, (first, last) in zip(blocks, pairwise([0, *jumps, n_times - 1]), strict=True):
        columns = slice(first, last + 1)
        strain[columns, columns] += block.strain
        skip = int(first > 0)
        rate[first + skip : last + 1, columns] = block.rate[skip:]
    strain[list(jumps)] *= 0.5
    return Operators(strain, rate)
