"""Linear maps to the strain and rate that a smoother makes: from the measured strain, or from what is unknown."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Operators:
    """What each source does to strain and rate.

    Sources are the measured samples, at fixed smoothness, or independent errors of one standard deviation.

    Attributes
    ----------
    strain : ndarray, shape (n_used, n_sources) [-]
        d strain used / d source.
    rate : ndarray, shape (n_used, n_sources) [1/s]
        d rate used / d source.
    """

    strain: FloatArray
    rate: FloatArray
