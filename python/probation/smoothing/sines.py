"""A sum of a few sines through residuals: their number by a criterion, their frequencies free."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.optimize import least_squares

from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Sines:
    r"""The sum.

    .. math:: r(t) = \sum_k A_k \cos 2\pi f_k t + B_k \sin 2\pi f_k t

    Attributes
    ----------
    frequencies : ndarray, shape (count,) [Hz]
    weights : ndarray, shape (2 count,)
        A, then B.
    start : float [s]
        Where t is zero.
    """

    frequencies: FloatArray
    weights: FloatArray
    start: float

    def __call__(self, time: FloatArray) -> FloatArray:
        """The sum at `time` [s], shape (n_times,)."""
        value: FloatArray = _waves(time - self.start, self.frequencies) @ self.weights
        return value

    def derivative(self, time: FloatArray) -> FloatArray:
        """Its derivative by time, shape (n_times,) [1/s]."""
        slope: FloatArray = _wave_slopes(time - self.start, self.frequencies) @ self.weights
        return slope

    def jacobian(self, time: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Derivatives of the sum, and of its slope, along weights and frequencies; each (n_times, 3 count)."""
        t = (time - self.start)[:, None]
        angle = 2.0 * np.pi * self.frequencies * t
        A, B = np.split(self.weights, 2)
        turn = 2.0 * np.pi * (B * np.cos(angle) - A * np.sin(angle))  # by f, over t
        bend = -2.0 * np.pi * (A * np.cos(angle) + B * np.sin(angle)) * 2.0 * np.pi * self.frequencies
        values = np.hstack([_waves(t[:, 0], self.frequencies), t * turn])
        slopes = np.hstack([_wave_slopes(t[:, 0], self.frequencies), turn + t * bend])
        return values, slopes


def fit_sines(time: FloatArray, residual: FloatArray, weights: FloatArray | None = None) -> Sines:
    """Fit 0, 1, 2, … sines and keep as many as the Bayesian information criterion wants.

    Each is added where the periodogram of what is left peaks; then all frequencies move (variable projection). The
    criterion takes the noise as autoregressive, with the correlation of neighbours that the largest sum leaves:
    correlated noise, whose slow part looks like sines, does not buy more of them.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    residual : ndarray, shape (n_times,)
    weights : ndarray, shape (n_times,), optional
        One over the noise of each sample, up to a factor.
    """
    weight = np.ones_like(time) if weights is None else weights
    start, duration = float(time[0]), float(time[-1] - time[0])
    x, means, sums = _blocks((time - start) / duration, residual, weight)  # frequencies in cycles per record
    fit = partial(_Fit, x, sums, sums * means)
    count = len(x)
    grid = np.arange(
        SMOOTHING.slowest_sine, min(SMOOTHING.fastest_sine, count / SMOOTHING.samples_per_cycle), SMOOTHING.sine_spacing
    )
    turns = np.exp(2j * np.pi * np.outer(grid, x))
    fits = [fit(np.empty(0))]
    while len(fits) <= min(SMOOTHING.most_sines, len(grid) // 4) and not _settled(fits):
        peak = grid[int(np.argmax(np.abs(turns @ (sums * fits[-1].rest))))]
        fits.append(_refined(fit, np.append(fits[-1].frequencies, peak), float(grid[-1])))
    best = fits[int(np.argmin(_criteria(fits)))].frequencies
    whole = _Fit((time - start) / duration, weight, weight * residual, best)
    return Sines(best / duration, whole.weights, start)


def _settled(fits: Sequence[_Fit]) -> bool:
    """Whether the last `SMOOTHING.sines_in_vain` sines were not wanted."""
    return len(fits) > SMOOTHING.sines_in_vain and int(np.argmin(_criteria(fits))) < len(fits) - SMOOTHING.sines_in_vain


def _criteria(fits: Sequence[_Fit]) -> list[float]:
    """The Bayesian information criterion of each, the noise being what the last leaves."""
    last = fits[-1].rest
    count = len(last)
    neighbours = float(np.clip(last[1:] @ last[:-1] / max(float(last @ last), 1e-300), 0.0, 0.98))
    innovations = (sines.rest[1:] - neighbours * sines.rest[:-1] for sines in fits)
    return [
        count * float(np.log(max(float(rest @ rest), 1e-300))) + 3 * number * float(np.log(count))
        for number, rest in enumerate(innovations)
    ]


def _blocks(t: FloatArray, values: FloatArray, weight: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Weighted means of neighbouring samples and one over their noise: they know what slow sines need."""
    size = max(len(t) // SMOOTHING.sine_blocks, 1)
    first = np.arange(0, len(t), size)
    total = np.add.reduceat(weight**2, first)
    times, means = (np.add.reduceat(weight**2 * samples, first) / total for samples in (t, values))
    return times, means, np.sqrt(total)


class _Fit:
    """Weighted least squares of waves of given frequencies."""

    def __init__(self, t: FloatArray, weight: FloatArray, weighted: FloatArray, frequencies: FloatArray) -> None:
        self.frequencies = frequencies
        self.weights: FloatArray = np.empty(0)
        waves = _waves(t, frequencies) * weight[:, None]
        if len(frequencies):
            self.weights = np.asarray(np.linalg.lstsq(waves, weighted, rcond=1e-10)[0], dtype=np.float64)
        self.rest = weighted - waves @ self.weights
        self.squares = float(self.rest @ self.rest)


def _waves(t: FloatArray, frequencies: FloatArray) -> FloatArray:
    angle = 2.0 * np.pi * np.outer(t, frequencies)
    return np.hstack([np.cos(angle), np.sin(angle)])


def _wave_slopes(t: FloatArray, frequencies: FloatArray) -> FloatArray:
    turn = 2.0 * np.pi * frequencies
    angle = np.outer(t, turn)
    return np.hstack([-turn * np.sin(angle), turn * np.cos(angle)])


def _refined(fit: Callable[[FloatArray], _Fit], start: FloatArray, highest: float) -> _Fit:
    """The frequencies near `start` that leave the least."""
    inside = np.clip(start, SMOOTHING.slowest_sine + 1e-6, highest - 1e-6)
    size = float(np.std(fit(inside).rest)) or 1.0

    def rest(frequencies: FloatArray) -> FloatArray:
        return fit(frequencies).rest / size

    minimum = least_squares(rest, inside, bounds=(SMOOTHING.slowest_sine, highest), max_nfev=60)
    return fit(np.asarray(minimum.x))
