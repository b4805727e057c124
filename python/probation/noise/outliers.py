"""Single readings that belong to nothing: found, reported, and kept out of the statistics."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.normal import SD_OF_MEDIAN, UPPER_95
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray


def find_outliers(residual: FloatArray, jumps: Sequence[int] = ()) -> tuple[int, ...]:
    """Indices of isolated readings, far from both of their sides, which agree with each other.

    A sample is compared with the median of the three before and the three after a window of `NOISE.longest_outlier`
    around it; the start and the rate discontinuities, where a model may err sharply, are left alone.

    Parameters
    ----------
    residual : ndarray, shape (n,) [MPa]
    jumps : sequence of int
        Indices at which the strain rate is discontinuous.

    Returns
    -------
    tuple of int
        Empty where more than `NOISE.most_outliers` of the record (and more than three readings) stand out: that is
        noise.
    """
    count, arm, inner = len(residual), 3, NOISE.longest_outlier
    reach = arm + inner - 1
    if count < 4 * reach + 4:
        return ()
    padded = np.pad(residual, reach, mode="reflect")
    shifts = [np.roll(padded, shift)[reach:-reach] for shift in range(-reach, reach + 1) if abs(shift) >= inner]
    sides = np.stack(shifts)
    later, earlier = np.median(sides[:arm], axis=0), np.median(sides[arm:], axis=0)
    away = residual - 0.5 * (later + earlier)
    spread = SD_OF_MEDIAN * float(np.median(np.abs(away)))
    spread = max(spread, float(np.quantile(np.abs(away), 0.9)) / UPPER_95, 1e-300)
    out = (np.abs(away) > NOISE.outlier_distance * spread) & (
        np.abs(later - earlier) < NOISE.outlier_sides * np.abs(away)
    )
    for border in (0, *jumps):
        out[max(border - reach, 0) : border + reach + 1] = False
    outlying = np.flatnonzero(out)
    lone = [int(i) for i in outlying if np.count_nonzero(np.abs(outlying - i) <= reach) <= NOISE.longest_outlier]
    if len(lone) < len(outlying) or len(lone) > max(3, NOISE.most_outliers * count):
        return ()
    return tuple(lone)


def without_outliers(values: FloatArray, outliers: Sequence[int]) -> FloatArray:
    """`values`, (n,) or (n, m), with the outliers replaced by the straight line between their neighbours."""
    if not len(outliers):
        return values
    keep = np.ones(len(values), dtype=bool)
    keep[list(outliers)] = False
    index = np.arange(len(values))
    cleaned = values.copy()
    for column in cleaned.reshape(len(values), -1).T:
        column[~keep] = np.interp(index[~keep], index[keep], column[keep])
    return cleaned
