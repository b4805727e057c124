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
    from probation.noise.model import NoiseModel
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
    return {
        index: replace(record, residual=_without_steps(record.residual))
        for index, (record, noise) in enumerate(zip(whitened.records, whitened.noises, strict=True))
        if len(record) >= DETECTION.fewest_for_steps * DETECTION.slowest_line and _mostly_quieter(record, noise)
    }


def _mostly_quieter(record: RecordResidual, noise: NoiseModel) -> bool:
    """Whether most samples differ from the next one by much less than the noise has it."""
    usual = float(np.median(noise.deviation)) * np.sqrt(2.0 * (1.0 - noise.correlation))
    return bool(_usual_difference(record.residual) < DETECTION.mostly_quieter * usual)


def _usual_difference(residual: FloatArray) -> float:
    """Standard deviation of differences of neighbours, by their median [MPa]."""
    return SD_OF_MEDIAN * float(np.median(np.abs(np.diff(residual))))


def _without_steps(residual: FloatArray) -> FloatArray:
    """A residual (n,) without what is sharper than its usual differences; not beyond so many steps."""
    for _ in range(DETECTION.most_hidden_steps):
        if np.max(np.abs(np.diff(residual))) < DETECTION.sharp_difference * _usual_difference(residual):
            break
        residual = _without_sharpest(residual)
    return residual


def _without_sharpest(residual: FloatArray) -> FloatArray:
    """A residual (n,) without the step where neighbours differ most, and what follows from it; its edge bridged."""
    count = len(residual)
    place = int(np.argmax(np.abs(np.diff(residual)))) + 1
    since = np.arange(count) - place
    recovering = np.exp(-np.maximum(since, 0)[:, None] / (np.array(_RECOVERIES) * count)) * (since >= 0)[:, None]
    near = (since >= -_BEFORE - _EDGE) & (since <= 2.0 * _RECOVERIES[0] * count) & (np.abs(since + 0.5) > _EDGE)
    columns = np.column_stack([np.ones(count), recovering])
    size = np.linalg.lstsq(columns[near], residual[near], rcond=None)[0]
    left = residual - recovering @ size[1:]
    edge = np.abs(since + 0.5) <= _EDGE
    left[edge] = np.interp(since[edge], since[~edge], left[~edge])
    return np.asarray(left)
