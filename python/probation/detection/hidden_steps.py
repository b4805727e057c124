"""Several steps in one record, from which the stress recovers: they hide each other from a test for one of them.

Each is one of many large values, and no larger than these lead one to expect. But most of the record's differences from
sample to sample are then much smaller than its noise has them.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.normal import SD_OF_MEDIAN
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.record_residual import RecordResidual
    from probation.noise.whitening import Whitened

_EDGE = 2
"""Samples before and after a step that its edge may take."""

_BEFORE = 8
"""Samples before a step that tell from where the stress falls."""

_RECOVERIES = (0.1, 0.03, 0.01)
"""Parts of the record's samples in which the stress recovers, by threes: it recovers in all modes of a spectrum."""


def without_hidden_steps(whitened: Whitened) -> dict[int, RecordResidual]:
    """Records whose noise is one that steps may have made, without these."""
    taken = {}
    for index, (record, noise) in enumerate(zip(whitened.records, whitened.noises, strict=True)):
        usual = SD_OF_MEDIAN * float(np.median(np.abs(np.diff(record.residual))))
        expected = float(np.median(noise.deviation)) * np.sqrt(2.0 * (1.0 - noise.correlation))
        if 0.0 < usual < DETECTION.mostly_quieter * expected:
            left = _without_steps(record.residual, DETECTION.sharp_difference * usual)
            if left is not None:
                taken[index] = replace(record, residual=left)
    return taken


def _without_steps(residual: FloatArray, sharp: float) -> FloatArray | None:
    """A residual (n,) without its differences beyond `sharp` [MPa] and what follows from them; None if with all.

    Where the stress does not recover from the sharpest one it is a loud reading, and the others stay, too.
    """
    left = None
    for _ in range(min(DETECTION.most_hidden_steps, len(residual) // DETECTION.samples_per_step)):
        without = _without_sharpest(residual if left is None else left, sharp)
        if without is None:
            break
        left = without
    return left


def _without_sharpest(residual: FloatArray, sharp: float) -> FloatArray | None:
    """The same without the sharpest one, its edge bridged; None where none is, or what follows it is no recovery."""
    count, differences = len(residual), np.diff(residual)
    # Nothing comes before the first samples from which the stress could fall: what is sharp there stays.
    place = int(np.argmax(np.abs(differences[_BEFORE - 1 :]))) + _BEFORE
    differences *= np.sign(differences[place - 1])
    if differences[place - 1] <= sharp:
        return None
    since = np.arange(count) - place
    edge = np.abs(since + 0.5) <= _EDGE
    following = np.flatnonzero((differences > sharp) & (since[1:] > _EDGE))
    end = following[0] - _EDGE if following.size else count
    near = (since >= -_BEFORE - _EDGE) & (since <= 2.0 * _RECOVERIES[0] * count) & (np.arange(count) <= end) & ~edge
    recovering = np.exp(-np.maximum(since, 0)[:, None] / (np.array(_RECOVERIES) * count)) * (since >= 0)[:, None]
    columns = np.column_stack([np.ones(count), recovering])
    if np.count_nonzero(near) < 2 * columns.shape[1]:  # the next one is too close
        return None
    size = np.linalg.lstsq(columns[near], residual[near], rcond=None)[0]
    rest = residual[near] - columns[near] @ size
    if not np.sum(rest**2) < DETECTION.left_by_a_step * np.sum((residual[near] - np.mean(residual[near])) ** 2):
        return None
    left = residual - recovering @ size[1:]
    left[edge] = np.interp(since[edge], since[~edge], left[~edge])
    return np.asarray(left)
