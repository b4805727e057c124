"""Smooth histories, known at every instant, on which an order of accuracy can be observed."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

from probation._arrays import FloatArray, as_samples

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


class SmoothHistory(Protocol):
    """A strain history with its rate in closed form."""

    @property
    def duration(self) -> float:
        """[s]."""

    def true_strain(self, time: ArrayLike) -> FloatArray:
        """True strain [-] at `time` [s], both of shape (n_times,)."""

    def strain_rate(self, time: ArrayLike) -> FloatArray:
        """Its derivative [1/s]."""


@dataclass(frozen=True)
class RampHistory:
    """Constant strain rate: eq. (7) gives the stress in closed form.

    Attributes
    ----------
    rate : float [1/s]
    duration : float [s]
    """

    rate: float
    duration: float

    def true_strain(self, time: ArrayLike) -> FloatArray:
        """True strain [-] at `time` [s], both of shape (n_times,)."""
        return self.rate * as_samples(time, "time")

    def strain_rate(self, time: ArrayLike) -> FloatArray:
        """Its derivative [1/s]."""
        return 0.0 * as_samples(time, "time") + self.rate
