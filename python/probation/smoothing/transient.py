"""What a machine makes of a command that changes at once: the strain lags, and bends within some samples.

A smoother's stiffness is that of the whole segment. It takes such a transient for noise, and the law is stiffest there.
A first-order lag of time constant T after a change of the rate by v leaves the straight line by v T exp(-t / T). A few
time constants, about a sampling interval and some multiples, stand for other lags; each has a standard deviation of
v T. They are left out where the samples tell that the start is sharp; it is then smoothed as any other part.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Transient:
    """Lags after the start of a segment, each of one standard deviation.

    Attributes
    ----------
    strain : ndarray, shape (n_times, n_lags) [-]
    rate : ndarray, shape (n_times, n_lags) [1/s]
    """

    strain: FloatArray
    rate: FloatArray

    @classmethod
    def after(cls, time: FloatArray, change: float) -> Transient:
        """After a change of the rate [1/s] at the first sample."""
        interval = float(np.median(np.diff(time[: SMOOTHING.border_samples + 1])))
        constants = np.array(SMOOTHING.lag_times) * interval
        fading = np.exp(-(time - time[0])[:, None] / constants)
        return cls(change * constants * fading, -change * fading)

    def of_samples(self, kept: slice) -> Transient:
        """The same at some of the samples."""
        return Transient(self.strain[kept], self.rate[kept])


def rate_change(time: FloatArray, true_strain: FloatArray, at: int, before: int, after: int) -> float:
    """By how much the rate changes [1/s] at sample `at`: straight lines to either side, no further than these samples.

    Before the first sample the specimen is at rest.
    """

    def slope(part: slice) -> float:
        return float(np.polyfit(time[part] - time[at], true_strain[part], 1)[0]) if part.stop - part.start > 1 else 0.0

    return slope(slice(at, min(at + SMOOTHING.border_samples, after) + 1)) - slope(
        slice(max(at - SMOOTHING.border_samples, before), at + 1)
    )


@dataclass(frozen=True, eq=False)
class WithTransient:
    """A smoother S and lags B together: what is left of the samples is B c + S (y - B c), c the likeliest lags.

    Attributes
    ----------
    left : ndarray, shape (n_times, n_lags)
        (I - S) B.
    gain : ndarray, shape (n_lags, n_times)
        c = gain y.
    covariance : ndarray, shape (n_lags, n_lags)
        Of c, over the variance of the noise.
    """

    lags: Transient
    left: FloatArray
    gain: FloatArray
    covariance: FloatArray

    @classmethod
    def of(
        cls, lags: Transient, smooth: Callable[[FloatArray], FloatArray], values: FloatArray, noise: float
    ) -> WithTransient | None:
        """For a symmetric smoother at a fixed smoothness; None where the samples show that there are no lags.

        Long lags, which take from the smoother's freedom what it may need elsewhere, only where they are more probable.

        Parameters
        ----------
        smooth : callable
            S, of columns.
        values : ndarray, shape (n_times,)
            The samples [-].
        noise : float
            Standard deviation of their slow noise [-].
        """
        best, most = None, -SMOOTHING.lag_caution
        for count in (SMOOTHING.short_lags, lags.strain.shape[1]):
            some = Transient(lags.strain[:, :count], lags.rate[:, :count])
            made, evidence = cls._weighed(some, smooth, values, noise)
            if evidence > most:
                best, most = made, evidence
        return best

    @classmethod
    def _weighed(
        cls, lags: Transient, smooth: Callable[[FloatArray], FloatArray], values: FloatArray, noise: float
    ) -> tuple[WithTransient, float]:
        """With these lags, and twice the log odds for them."""
        left = lags.strain - smooth(lags.strain)
        variance = (
            max(noise, SMOOTHING.least_strain_noise * float(np.max(np.abs(lags.strain), initial=0.0)), 1e-150) ** 2
        )
        normal = np.eye(left.shape[1]) + lags.strain.T @ left / variance
        covariance = np.asarray(np.linalg.inv(normal) / variance, dtype=np.float64)
        pull = left.T @ values
        evidence = float(pull @ covariance @ pull) / variance - float(np.linalg.slogdet(normal)[1])
        return cls(lags, left, covariance @ left.T, covariance), evidence

    @property
    def freedom(self) -> float:
        """Degrees of freedom that the lags take."""
        return float(np.sum(self.gain * self.left.T))
