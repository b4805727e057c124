"""What a smoother answers, for one segment or for a whole record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Protocol

import numpy as np

from probation.settings.noise import NOISE
from probation.smoothing.operators import Operators

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.smoothing.rate_change import RateChange


ROUNDS = 20
"""Most rounds between smoothness and the autocorrelation of the residual."""


@dataclass(frozen=True, eq=False)
class Smoothed:
    """Strain and rate at the samples, and what is known about them.

    Attributes
    ----------
    true_strain : ndarray, shape (n_times,) [-]
    strain_rate : ndarray, shape (n_times,) [1/s]
    strain_error : ndarray, shape (n_times,) [-]
        Standard error of the strain for strain noise of standard deviation 1, correlated as it is (`inflation`).
    rate_error : ndarray, shape (n_times,) [1/s]
        ... and of the rate.
    freedom : float
        Degrees of freedom that the smoother spends on the samples.
    squares : float
        Sum of the squared residuals, measured - smoothed [-].
    inflation : float
        Variance of slow averages of the noise over what white noise would have: 1 where it is white.
    operators : callable
        Makes the operators of the measured samples, which are dense.
    errors : callable, or None
        Makes those of independent errors for strain noise of standard deviation 1, correlated as it is: what is unknown
        of strain and rate. None: the noise of the samples, through `operators`, is all.
    """

    true_strain: FloatArray
    strain_rate: FloatArray
    strain_error: FloatArray
    rate_error: FloatArray
    freedom: float
    squares: float
    inflation: float
    operators: Callable[[], Operators]
    errors: Callable[[], Operators] | None = None

    @property
    def noise(self) -> float:
        """Standard deviation of the measured strain around the smoothed one [-]."""
        left = max(len(self.true_strain) - self.freedom, 1.0)
        return float(np.sqrt(self.squares / left))


class Smoother(Protocol):
    """Makes strain and rate of the samples of one segment, along which the rate does not jump."""

    def __call__(self, time: FloatArray, true_strain: FloatArray) -> Smoothed:
        """Smooth; both arrays have the shape (n_times,) and hold no jump."""


class LaggingSmoother(Smoother, Protocol):
    """One that can tell the start of the segment from its noise, also where that is averaged."""

    def __call__(
        self, time: FloatArray, true_strain: FloatArray, begins: RateChange | None = None, averaged: float | None = None
    ) -> Smoothed:
        """Smooth; `begins` is the change at the start, `averaged` the least inflation, sought if None."""


def inflation(residual: FloatArray) -> float:
    """How far autocorrelated noise exceeds white noise in slow averages: 1 + 2 sum of the autocorrelation, at least 1.

    Summed to the first lag at which the autocorrelation is within chance, 2 / sqrt(n).
    """
    count = len(residual)
    total = float(residual @ residual)
    if total == 0.0 or count < NOISE.fewest_for_inflation:
        return 1.0
    spectrum = np.abs(np.fft.rfft(residual, 2 * count)) ** 2
    correlation = np.fft.irfft(spectrum)[1 : count // 2] / total
    chance = np.flatnonzero(correlation < 2.0 / np.sqrt(count))
    last = int(chance[0]) if chance.size else len(correlation)
    return 1.0 + 2.0 * float(correlation[:last].sum())


def polynomial(time: FloatArray, true_strain: FloatArray, degree: int) -> Smoothed:
    """The least-squares polynomial of that degree: what too few samples for a smoother get."""
    middle, half = 0.5 * (time[0] + time[-1]), 0.5 * (time[-1] - time[0])
    x = (time - middle) / half
    basis, triangle = np.linalg.qr(np.polynomial.legendre.legvander(x, degree))
    slopes = np.zeros_like(basis)
    for order in range(1, degree + 1):
        unit = np.zeros(degree + 1)
        unit[order] = 1.0
        slopes[:, order] = np.polynomial.legendre.legval(x, np.polynomial.legendre.legder(unit)) / half
    slopes = np.linalg.solve(triangle.T, slopes.T).T
    weights = basis.T @ true_strain
    strain = basis @ weights
    return Smoothed(
        strain,
        slopes @ weights,
        np.sqrt((basis**2).sum(axis=1)),
        np.sqrt((slopes**2).sum(axis=1)),
        degree + 1.0,
        float(np.sum((true_strain - strain) ** 2)),
        1.0,
        lambda: Operators(basis @ basis.T, slopes @ basis.T),
    )
