"""What a machine makes of a command that changes at once: it takes some samples to get to the new speed.

A smoother's stiffness is that of the whole segment. It takes such a start for noise, and the law is stiffest there. A
drive accelerates evenly, or along half a wave, or lags as a loop of first or second order does, which may overshoot.
What all of them leave of the change of the rate, v, is a cubic spline of the time since, over knots that lie further
and further apart, and ends. Its functions are as large as a part of v, each by itself and all up to a knot together,
less where they end later than a start usually does. They are left out where the samples tell that the start is sharp;
it is then smoothed as any other part. What the samples hardly tell is doubted: on the way to the other answer the
strain may err.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import BSpline

from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray
    from probation.smoothing.rate_change import RateChange

DEGREE = 3
"""Of the splines in what a start leaves."""


@dataclass(frozen=True, eq=False)
class Transient:
    """What a start may leave: lags, each of one standard deviation.

    Attributes
    ----------
    strain : ndarray, shape (n_times, n_lags) [-]
    rate : ndarray, shape (n_times, n_lags) [1/s]
    """

    strain: FloatArray
    rate: FloatArray

    @classmethod
    def after(cls, time: FloatArray, change: RateChange) -> Transient:
        """At times (n_times,) [s] after a change of the rate."""
        knots = np.array(SMOOTHING.start_knots)
        padded = np.concatenate([knots[:1].repeat(DEGREE), knots, knots[-1:].repeat(DEGREE)])
        every = BSpline(padded, np.eye(len(padded) - DEGREE - 1), DEGREE)
        since = np.minimum((time - change.at) / change.interval, knots[-1])
        # The last functions do not come to rest at the last knot.
        ends = padded[DEGREE + 1 : -DEGREE]
        travelled = every.antiderivative()
        left, lost = (travelled(knots[-1]) - travelled(since))[:, : len(ends)], every(since)[:, : len(ends)]
        # Each function by itself, and all of them up to a knot: a start that lasts until then.
        ways = np.hstack([np.eye(len(ends)), np.triu(np.ones((len(ends), len(ends))))])
        ways *= SMOOTHING.start_part * np.tile(np.minimum(1.0, SMOOTHING.usual_start / ends), 2)
        root = change.by * np.linalg.cholesky(ways @ ways.T)
        return cls(change.interval * left @ root, -lost @ root)

    @classmethod
    def none(cls, count: int) -> Transient:
        """A sharp start, of so many samples."""
        return cls(np.zeros((count, 0)), np.zeros((count, 0)))


@dataclass(frozen=True, eq=False)
class WithTransient:
    """A smoother S and lags B together: what is left of the samples is B c + S (y - B c), c the likeliest lags.

    Attributes
    ----------
    lags : Transient
        B.
    likeliest : ndarray, shape (n_lags,)
        c.
    left : ndarray, shape (n_times, n_lags)
        (I - S) B.
    gain : ndarray, shape (n_lags, n_times)
        c = gain y.
    root : ndarray, shape (n_lags, n_lags)
        Its product with its transpose is the covariance of c over the variance of the noise.
    noise : float
        Standard deviation of the samples' slow noise [-].
    doubt : (WithTransient, float) or None
        The other answer, and twice the log odds for this against it.
    """

    lags: Transient
    likeliest: FloatArray
    left: FloatArray
    gain: FloatArray
    root: FloatArray
    noise: float
    doubt: tuple[WithTransient, float] | None = None

    @classmethod
    def of(
        cls, lags: Transient, smooth: Callable[[FloatArray], FloatArray], values: FloatArray, noise: float
    ) -> WithTransient:
        """For a symmetric smoother at a fixed smoothness; without lags where they are improbable by `lag_caution`.

        Parameters
        ----------
        smooth : callable
            S, of columns.
        values : ndarray, shape (n_times,)
            The samples [-].
        noise : float
            Standard deviation of their slow noise [-].
        """
        noise = max(noise, SMOOTHING.least_strain_noise * float(np.max(np.abs(lags.strain), initial=0.0)), 1e-150)
        with_lags, evidence = cls._weighed(lags, smooth, values, noise)
        sharp, _ = cls._weighed(Transient.none(len(values)), smooth, values, noise)
        odds = evidence + SMOOTHING.lag_caution
        best, other = (with_lags, sharp) if odds > 0.0 else (sharp, with_lags)
        return replace(best, doubt=(other, abs(odds)))

    @classmethod
    def _weighed(
        cls, lags: Transient, smooth: Callable[[FloatArray], FloatArray], values: FloatArray, noise: float
    ) -> tuple[WithTransient, float]:
        """With these lags, and twice the log odds for them."""
        left = lags.strain - smooth(lags.strain)
        # The samples tell little of some functions apart: an inverse would not be positive.
        precision, along = np.linalg.eigh(np.eye(left.shape[1]) + lags.strain.T @ left / noise**2)
        precision = np.maximum(precision, 1.0)
        root = along / (noise * np.sqrt(precision))
        pull = root.T @ (left.T @ values)
        evidence = float(pull @ pull) / noise**2 - float(np.sum(np.log(precision)))
        return cls(lags, root @ pull, left, root @ (root.T @ left.T), root, noise), evidence

    @property
    def freedom(self) -> float:
        """Degrees of freedom that the lags take."""
        return float(np.sum(self.gain * self.left.T))
