"""The linear map from measured strain to the strain and rate that a smoother makes of it, at fixed smoothness."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
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
