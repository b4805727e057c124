"""Segments of a record, and what polynomials on each of them leave: no law's error is as rough."""

from __future__ import annotations

from functools import lru_cache
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


def in_segments(values: FloatArray, jumps: Sequence[int]) -> list[FloatArray]:
    """Segments of nearly equal length that end at the jumps, without those that are too short to tell anything."""
    return [part for part in _segments(values, jumps) if len(part) >= NOISE.shortest_segment // 2]


def leftover(values: FloatArray, jumps: Sequence[int]) -> FloatArray:
    """What polynomials on segments leave, every sample; short segments give zeros."""
    parts = []
    for part in _segments(values, jumps):
        basis = legendre(len(part), min(NOISE.segment_degree, max(len(part) - 2, 0))) if len(part) else np.zeros((0, 1))
        parts.append(part - basis @ (basis.T @ part))
    return np.concatenate(parts)


@lru_cache(maxsize=256)
def legendre(count: int, degree: int) -> FloatArray:
    """Orthonormal polynomials up to a degree on so many samples, one a column."""
    place = np.linspace(-1.0, 1.0, count)
    return np.linalg.qr(np.polynomial.legendre.legvander(place, degree))[0]


def _segments(values: FloatArray, jumps: Sequence[int]) -> list[FloatArray]:
    target = max(len(values) // NOISE.segments, NOISE.shortest_segment)
    borders = [0, *sorted(jumps), len(values)]
    return [
        part
        for first, last in pairwise(borders)
        for part in np.array_split(values[first:last], max((last - first) // target, 1))
    ]
