"""A change of the strain rate at a sample: the start of a test, or a jump."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True)
class RateChange:
    """When and by how much the rate changes.

    Attributes
    ----------
    at : float [s]
    by : float [1/s]
    interval : float [s]
        Between the samples behind it.
    """

    at: float
    by: float
    interval: float

    @classmethod
    def of(cls, time: FloatArray, true_strain: FloatArray, at: int, before: int, after: int) -> RateChange:
        """At sample `at`, by straight lines to either side, no further than the samples `before` and `after`.

        Before the first sample the specimen is at rest.
        """

        def slope(part: slice) -> float:
            some = part.stop - part.start > 1
            return float(np.polyfit(time[part] - time[at], true_strain[part], 1)[0]) if some else 0.0

        behind = slice(at, min(at + SMOOTHING.border_samples, after) + 1)
        change = slope(behind) - slope(slice(max(at - SMOOTHING.border_samples, before), at + 1))
        return cls(float(time[at]), change, float(np.median(np.diff(time[behind]))))
