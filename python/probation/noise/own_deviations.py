"""What of a residual is the specimens' own: their most probable deviations, no larger than scatter makes them."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.special import chdtri

from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel


def own_deviations(residuals: Sequence[FloatArray], noises: Sequence[NoiseModel]) -> list[FloatArray]:
    """The part of each record's residual that its specimen's deviations make, by record; each of shape (n_r,) [MPa].

    The conditional mean of random effects (best linear unbiased prediction); longer than all but
    `NOISE.unusual_specimen` of them, it is shortened to that.

    Parameters
    ----------
    residuals : sequence of ndarray, shape (n_r,) [MPa]
        Without outliers.
    noises : sequence of NoiseModel
        With the specimens' scatter.
    """
    parts = [np.zeros(len(residual)) for residual in residuals]
    for members, size in deviations_of(residuals, noises):
        shortened = min(1.0, _usual(size) / max(float(np.linalg.norm(size)), 1e-300)) * size
        for index in members:
            columns = noises[index].specimen
            assert columns is not None
            parts[index] = columns @ shortened
    return parts


def furthest_specimen(residuals: Sequence[FloatArray], noises: Sequence[NoiseModel]) -> float:
    """How far the furthest specimen deviates, in units of what all but `NOISE.unusual_specimen` of them stay below.

    Parameters
    ----------
    residuals : sequence of ndarray, shape (n_r,) [MPa]
        Without outliers.
    noises : sequence of NoiseModel
        With the specimens' scatter.
    """
    return max(_lengths(residuals, noises), default=0.0)


def specimens_within(residuals: Sequence[FloatArray], noises: Sequence[NoiseModel], most: float) -> bool:
    """Whether no specimen deviates further than `most`, as `furthest_specimen` counts; ends at the first that does."""
    return all(length <= most for length in _lengths(residuals, noises))


def _lengths(residuals: Sequence[FloatArray], noises: Sequence[NoiseModel]) -> Iterator[float]:
    """How far each specimen deviates, over what is usual."""
    return (float(np.linalg.norm(size)) / _usual(size) for _, size in deviations_of(residuals, noises))


def _usual(size: FloatArray) -> float:
    """Longest that deviations of so many kinds usually are [standard deviations]."""
    return float(np.sqrt(chdtri(len(size), NOISE.unusual_specimen)))


def deviations_of(
    residuals: Sequence[FloatArray], noises: Sequence[NoiseModel]
) -> Iterator[tuple[list[int], FloatArray]]:
    """Records of each specimen, and its most probable deviations over their standard deviations, shape (k,).

    Parameters
    ----------
    residuals : sequence of ndarray, shape (n_r,) [MPa]
        Without outliers.
    noises : sequence of NoiseModel
        With the specimens' scatter.
    """
    for members in specimens_of(noises):
        normal, pull = np.zeros(()), np.zeros(())
        for index in members:
            white = noises[index].white_specimen
            if not white.shape[1]:
                continue
            normal = normal + white.T @ white
            pull = pull + white.T @ noises[index].alike.whiten(residuals[index])
        if normal.ndim:
            yield members, np.asarray(np.linalg.solve(np.eye(len(normal)) + normal, pull))


def specimen_columns(noises: Sequence[NoiseModel], slices: Sequence[slice]) -> list[FloatArray]:
    """What each specimen's deviations, of one standard deviation, do to all records: of shape (N, k) each [MPa]."""
    by_specimen = []
    for members in specimens_of(noises):
        first = noises[members[0]].specimen
        if first is None or not first.shape[1]:
            continue
        columns = np.zeros((slices[-1].stop, first.shape[1]))
        for index in members:
            columns[slices[index]] = noises[index].specimen
        by_specimen.append(columns)
    return by_specimen


def specimens_of(noises: Sequence[NoiseModel]) -> list[list[int]]:
    """Records of one specimen each, by their indices; without a name a record is a specimen of its own."""
    known: dict[tuple[bool, str], list[int]] = {}
    for index, noise in enumerate(noises):
        named = noise.specimen_id is not None
        known.setdefault((named, noise.specimen_id if noise.specimen_id is not None else noise.name), []).append(index)
    return list(known.values())
