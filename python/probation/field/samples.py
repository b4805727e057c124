"""Which samples of a pixel's record are good for the law: images lose pixels, for an instant or for good."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from probation.settings.field import FIELD

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation._arrays import FloatArray
    from probation.field.source import Samples

BoolArray: TypeAlias = NDArray[np.bool_]
IndexArray: TypeAlias = NDArray[np.intp]


def used_samples(strain: Samples, stress: Samples) -> BoolArray:
    """Samples up to the first long gap where both are finite; none where the first sample lacks, for the start is lost.

    Parameters
    ----------
    strain, stress : ndarray, shape (pixels, n_times)

    Returns
    -------
    ndarray of bool, shape (pixels, n_times)
    """
    there = np.isfinite(strain) & np.isfinite(stress)
    gap = FIELD.longest_gap + 1
    seen = np.cumsum(np.pad(there, ((0, 0), (1, 0))), axis=1)
    ends = np.zeros_like(there)
    ends[:, : there.shape[1] - FIELD.longest_gap] = seen[:, gap:] == seen[:, :-gap]  # nothing in the next `gap` samples
    before = ~np.maximum.accumulate(ends, axis=1)
    length = np.count_nonzero(before, axis=1)
    instants = there.shape[1]
    cut = length * FIELD.lengths // instants * instants // FIELD.lengths
    length = np.where(length < instants, cut, length)
    return np.asarray(there & (np.arange(there.shape[1]) < length[:, None]) & there[:, :1])


def of_equal_samples(used: BoolArray) -> Iterator[tuple[IndexArray, BoolArray]]:
    """Pixels that use the same samples, together: they share one time grid.

    Yields
    ------
    pixels : ndarray of int
    samples : ndarray of bool, shape (n_times,)
    """
    together: dict[bytes, list[int]] = {}
    for at, pattern in enumerate(np.packbits(used, axis=1)):
        together.setdefault(pattern.tobytes(), []).append(at)
    for pixels in together.values():
        yield np.array(pixels, dtype=np.intp), used[pixels[0]]


def bridged(
    time: FloatArray, values: Samples, used: BoolArray
) -> Iterator[tuple[IndexArray, BoolArray, NDArray[np.float64]]]:
    """Pixels whose records are of the same length, together, their short gaps bridged straight.

    Yields
    ------
    pixels : ndarray of int
    samples : ndarray of bool, shape (n_times,)
        Within the records, those in gaps too.
    values : ndarray, shape (len(pixels), samples in all)
    """
    within = np.maximum.accumulate(used[:, ::-1], axis=1)[:, ::-1]
    for pixels, samples in of_equal_samples(within):
        some = values[np.ix_(pixels, samples)].astype(np.float64)
        there = used[np.ix_(pixels, samples)]
        instants = time[samples]
        for at in np.flatnonzero(~there.all(axis=1)):
            some[at] = np.interp(instants, instants[there[at]], some[at, there[at]])
        yield pixels, samples, some
