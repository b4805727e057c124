"""The strain history of a necking specimen between grips that move at a constant speed, eq. (A-1)."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import FloatArray, as_samples
from probation.errors import InputError

if TYPE_CHECKING:
    from numpy.typing import ArrayLike


@dataclass(frozen=True)
class NeckingHistory:
    r"""Strain where the neck forms.

    .. math:: \varepsilon(t) = \frac{b\,t}{t^c + d\,e^{a t}}

    Parameters
    ----------
    a : float [1/s]
        Negative: the strain rate peaks where the exponential has died down.
    b : float [s^(c-1)]
    c : float [-]
        Between 0 and 1.
    d : float [s^c]
        Positive.
    duration : float [s]

    References
    ----------
    André et al., supplementary information, eq. (A-1).
    """

    a: float
    b: float
    c: float
    d: float
    duration: float

    def __post_init__(self) -> None:
        if not (0.0 < self.c < 1.0 and self.d > 0.0 and self.duration > 0.0):
            raise InputError(
                f"necking: found c = {self.c}, d = {self.d}, duration = {self.duration}; "
                "expected c between 0 and 1, d and duration positive"
            )

    def true_strain(self, time: ArrayLike) -> FloatArray:
        """True strain [-] at `time` [s], both of shape (n_times,)."""
        t = as_samples(time, "time")
        strain: FloatArray = self.b * t / self._denominator(t)
        return strain

    def strain_rate(self, time: ArrayLike) -> FloatArray:
        """Its derivative [1/s]: b [(1 - c) t^c + d e^(at) (1 - a t)] / (t^c + d e^(at))^2."""
        t = as_samples(time, "time")
        numerator = (1.0 - self.c) * t**self.c + self.d * np.exp(self.a * t) * (1.0 - self.a * t)
        rate: FloatArray = self.b * numerator / self._denominator(t) ** 2
        return rate

    def slowed(self, factor: float) -> NeckingHistory:
        """The same strains at grips that move `factor` times slower: a/s, b s^(c-1), d s^c, s T."""
        return replace(
            self,
            a=self.a / factor,
            b=self.b * factor ** (self.c - 1.0),
            d=self.d * factor**self.c,
            duration=self.duration * factor,
        )

    def _denominator(self, t: FloatArray) -> FloatArray:
        denominator: FloatArray = t**self.c + self.d * np.exp(self.a * t)
        return denominator


GRIP_SPEED = 0.08
"""Speed of the grips that the sets below belong to [mm/s]: experiment 3."""

NECKING_SETS: dict[str, NeckingHistory] = {
    "P1": NeckingHistory(a=-0.03236, b=0.37551, c=0.7035, d=153.25, duration=201.3),
    "P2": NeckingHistory(a=-0.03445, b=0.36637, c=0.7055, d=221.19, duration=224.7),
    "P3": NeckingHistory(a=-0.04781, b=0.158, c=0.5632, d=65.37, duration=262.3),
}
"""Parameters of (A-1), experiment 3, to true strain 1.8; with P2 the synthetic data return the paper's numbers."""
