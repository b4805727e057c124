"""ARMA(1,1) noise: its spectrum, its prediction-error filter, its simulation, its fit to a periodogram.

x_t = phi x_{t-1} + e_t + theta e_{t-1}. It contains white noise, AR(1), and AR(1) plus white noise (Box & Jenkins).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import solve_banded

from probation import _core
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray

START_UP, SETTLED = 150, 1e-7
"""Most steps of the exact start, and how near to one the variance of an innovation has settled; like theta^2t."""


_EDGES = np.geomspace(NOISE.lowest_frequency, np.pi * (1.0 + 1e-9), NOISE.spectrum_bins + 1)
_CENTRES = np.sqrt(_EDGES[1:] * _EDGES[:-1])


GRID, REFINED = 21, 3
"""Values of phi and theta that are searched, and the half-width of the later searches in their steps."""


@dataclass(frozen=True)
class Arma:
    """ARMA(1,1) with unit long-run level where `innovation` is (1 - phi)/(1 + theta).

    Attributes
    ----------
    phi, theta : float
        Below 1 in size.
    innovation : float
        Standard deviation of e.
    """

    phi: float = 0.0
    theta: float = 0.0
    innovation: float = 1.0

    @property
    def deviation(self) -> float:
        """Standard deviation of x."""
        excess = (self.phi + self.theta) ** 2 / (1.0 - self.phi**2)
        return float(self.innovation * np.sqrt(1.0 + excess))

    @property
    def long_run(self) -> float:
        """Square root of the spectrum at frequency zero: what sqrt(m) times the mean of m samples scatters by."""
        return self.innovation * (1.0 + self.theta) / (1.0 - self.phi)

    @property
    def rise(self) -> float:
        """Spectrum at frequency zero over that at a quarter of the sampling rate."""
        zero, middle = self.spectrum(np.array([0.0, 0.5 * np.pi]))
        return float(zero / middle)

    def spectrum(self, frequency: FloatArray) -> FloatArray:
        """Variance of an orthonormal Fourier coefficient at `frequency` [rad per sample]."""
        below = 1.0 - 2.0 * self.phi * np.cos(frequency) + self.phi**2
        return np.asarray(self.innovation**2 * self.moving_average(frequency) / below, dtype=np.float64)

    def moving_average(self, frequency: FloatArray) -> FloatArray:
        """The part of the spectrum that theta makes, that of innovations being 1: nearly 0 at pi where theta is 1."""
        return np.asarray(1.0 + 2.0 * self.theta * np.cos(frequency) + self.theta**2, dtype=np.float64)

    def whiten(self, matrix: FloatArray) -> FloatArray:
        """Unit-variance innovations of the columns of `matrix`, exact from the first sample (Brockwell & Davis)."""
        values = np.asarray(matrix, dtype=np.float64)
        count = len(values)
        none = np.zeros((count, 0)), np.zeros(0)
        engine = _core.Whitening(np.full(count, self.innovation), self.phi, self.theta, self.first_variances, *none)
        return engine.of(values.reshape(count, -1)).reshape(values.shape)

    @property
    def first_variances(self) -> FloatArray:
        """Of the first innovations given those before them, over that of e, until they settle; shape (k,)."""
        return _first_variances(self.phi, self.theta)

    def log_determinant(self, count: int) -> float:
        """Logarithm of the determinant of the covariance of so many samples."""
        phi, theta = self.phi, self.theta
        total = 2.0 * count * float(np.log(self.innovation))
        variance, done = (1.0 + 2.0 * phi * theta + theta**2) / (1.0 - phi**2), 0
        while done < count and abs(variance - 1.0) > 1e-12:
            total += float(np.log(variance))
            variance, done = 1.0 + theta**2 - theta**2 / variance, done + 1
        return total

    def simulate(self, rng: np.random.Generator, count: int, size: int = 1) -> FloatArray:
        """Draws, shape (size, count), stationary from the first sample."""
        shocks = rng.standard_normal((size, count))
        phi, theta = self.phi, self.theta
        if phi == 0.0 and theta == 0.0:
            return self.innovation * shocks
        # phi x + theta e of the sample before the first, of stationary variance (phi + theta)^2/(1 - phi^2).
        before = (phi + theta) / np.sqrt(1.0 - phi**2) * rng.standard_normal((size, 1))
        moved = shocks + np.hstack([before, theta * shocks[:, :-1]])
        bands = np.array([np.ones(count), np.full(count, -phi)])  # of x_t - phi x_{t-1}
        return np.asarray(self.innovation * solve_banded((1, 0), bands, moved.T).T)


@lru_cache(maxsize=256)
def _first_variances(phi: float, theta: float) -> FloatArray:
    variance = [(1.0 + 2.0 * phi * theta + theta**2) / (1.0 - phi**2)]
    while len(variance) < START_UP and abs(variance[-1] - 1.0) > SETTLED:
        variance.append(1.0 + theta**2 - theta**2 / variance[-1])
    return np.array(variance)


@dataclass(frozen=True, eq=False)
class Periodogram:
    """Squared orthonormal cosine coefficients, each over the part of it that a projection left.

    Attributes
    ----------
    frequency : ndarray, shape (m,) [rad per sample]
    power : ndarray, shape (m,)
    weight : ndarray, shape (m,)
        Samples' worth of each coefficient, 1 if nothing was projected out of it.
    """

    frequency: FloatArray
    power: FloatArray
    weight: FloatArray

    def binned(self) -> Periodogram:
        """Means over fixed bins, evenly spaced in the logarithm of the frequency; the weights add up, empty bins to 0.

        Where the spectrum is below `NOISE.dim_bin` of its largest value (beyond a filter), the fit should not bend for
        it.
        """
        place = np.clip(np.searchsorted(_EDGES, self.frequency, side="right") - 1, 0, NOISE.spectrum_bins - 1)
        weight: FloatArray = np.bincount(place, self.weight, NOISE.spectrum_bins).astype(np.float64)
        power = np.bincount(place, self.weight * self.power, NOISE.spectrum_bins) / np.maximum(weight, 1e-300)
        solid = weight >= NOISE.solid_bin
        if np.any(solid):
            weight = np.where(solid & (power < NOISE.dim_bin * np.max(power[solid])), NOISE.dim_weight * weight, weight)
        return Periodogram(_CENTRES, power, weight)


@dataclass(frozen=True, eq=False)
class ArmaFit:
    """Whittle's estimate of ARMA(1,1) noise that several records may share the shape of.

    Attributes
    ----------
    models : tuple of Arma
        One per periodogram.
    deviance : float
        Twice the negative Whittle log-likelihood.
    shape_variance : float
        Of the logarithm of the spectrum at low frequency, by the uncertain shape alone; shared by all records.
    level_variance : tuple of float
        Of the logarithm of each record's own level.
    """

    models: tuple[Arma, ...]
    deviance: float
    shape_variance: float
    level_variance: tuple[float, ...]


def fit_arma(periodograms: list[Periodogram], lowest: float) -> ArmaFit:
    """Fit ARMA(1,1) to periodograms by Whittle's likelihood, one shape and a level for each.

    White noise is kept unless the shape earns `NOISE.least_gain`; a rise towards the very lowest frequencies that were
    looked at, which the foot of a gap can feign in one record, must earn `NOISE.least_gain_of_low_rise` over the best
    shape without one, unless the spectrum is steep all along. A rise below them is never fitted.

    Parameters
    ----------
    periodograms : list of Periodogram
    lowest : float
        Lowest frequency that was looked at [rad per sample].
    """
    binned = [periodogram.binned() for periodogram in periodograms]
    deviance, best = float(_deviance(binned, np.zeros((1, 1, NOISE.spectrum_bins)))[0, 0]), (0.0, 0.0)
    tried, shape_of = _search(binned, max(1.0 - NOISE.no_rise_margin * lowest, NOISE.least_largest_phi))
    if deviance - tried > NOISE.least_gain:
        deviance, best = tried, shape_of
    tried, shape_of = _search(binned, max(1.0 - NOISE.low_rise_margin * lowest, NOISE.least_largest_phi))
    if deviance - tried > (NOISE.least_gain_of_low_rise if Arma(*best).rise < NOISE.steep_rise else 0.0):
        deviance, best = tried, shape_of
    shape = _table(np.array([best[0]]), np.array([best[1]]))[0, 0]
    levels = [float(_level(periodogram, shape)) for periodogram in binned]
    return ArmaFit(
        tuple(Arma(best[0], best[1], float(np.sqrt(level))) for level in levels),
        deviance,
        min(NOISE.fisher_excess * _shape_variance(binned, best), NOISE.largest_log_variance),
        tuple(2.0 / float(periodogram.weight.sum()) for periodogram in binned),
    )


def _search(binned: list[Periodogram], most_phi: float) -> tuple[float, tuple[float, float]]:
    """Least deviance over phi and theta, on ever finer grids, and where it is."""
    steps = np.array(
        [np.arctanh(most_phi) - np.arctanh(NOISE.smallest_phi), 2.0 * np.arctanh(NOISE.largest_moving_average)]
    ) / (GRID - 1)
    middle = np.array([np.arctanh(most_phi) + np.arctanh(NOISE.smallest_phi), 0.0]) / 2.0
    reach, deviance, best = (GRID - 1) // 2, np.inf, (0.0, 0.0)
    for _ in range(4):
        offsets = np.arange(-reach, reach + 1)
        phi = np.minimum(np.tanh(middle[0] + steps[0] * offsets), most_phi)
        theta = np.clip(
            np.tanh(middle[1] + steps[1] * offsets), -NOISE.largest_moving_average, NOISE.largest_moving_average
        )
        rise = np.outer((1.0 + phi**2) / (1.0 - phi) ** 2, (1.0 + theta) ** 2 / (1.0 + theta**2))
        table = np.where(rise >= NOISE.least_rise, _deviance(binned, _table(phi, theta)), np.inf)
        row, column = np.unravel_index(int(np.argmin(table)), table.shape)
        if table[row, column] < deviance:
            deviance, best = float(table[row, column]), (float(phi[row]), float(theta[column]))
        middle, steps, reach = np.arctanh(np.array(best)), steps / REFINED, REFINED
    return deviance, best


def _table(phi: FloatArray, theta: FloatArray) -> FloatArray:
    """Logarithm of the spectrum's shape at the bins' centres, shape (len(phi), len(theta), BINS)."""
    cosine = np.cos(_CENTRES)
    top = np.log(1.0 + 2.0 * np.outer(theta, cosine) + theta[:, None] ** 2)
    bottom = np.log(1.0 - 2.0 * np.outer(phi, cosine) + phi[:, None] ** 2)
    return np.asarray(top[None] - bottom[:, None], dtype=np.float64)


def _level(periodogram: Periodogram, shape: FloatArray) -> FloatArray:
    ratio = np.exp(-shape) @ (periodogram.power * periodogram.weight) / periodogram.weight.sum()
    return np.asarray(np.maximum(ratio, 1e-300), dtype=np.float64)


def _deviance(binned: list[Periodogram], shape: FloatArray) -> FloatArray:
    """Twice Whittle's negative log-likelihood, the levels profiled out; `shape` is (a, b, BINS)."""
    total = shape @ np.sum([periodogram.weight for periodogram in binned], axis=0)
    ratio = np.exp(-shape)
    for periodogram in binned:
        weight = periodogram.weight.sum()
        total += weight * (np.log(np.maximum(ratio @ (periodogram.power * periodogram.weight) / weight, 1e-300)) + 1.0)
    return np.asarray(total, dtype=np.float64)


def _shape_variance(binned: list[Periodogram], best: tuple[float, float]) -> float:
    """Variance of log S(0) by Fisher's information of (phi, theta), levels profiled out; 2 % added for white noise."""
    phi, theta = best

    def slopes(frequency: FloatArray) -> FloatArray:
        cosine = np.cos(frequency)
        along_phi = 2.0 * (cosine - phi) / (1.0 - 2.0 * phi * cosine + phi**2)
        along_theta = 2.0 * (cosine + theta) / (1.0 + 2.0 * theta * cosine + theta**2)
        return np.column_stack([along_phi, along_theta])

    information, means, weights = np.zeros((2, 2)), [], []
    for periodogram in binned:
        slope = slopes(periodogram.frequency)
        mean = periodogram.weight @ slope / periodogram.weight.sum()
        information += 0.5 * ((slope - mean).T * periodogram.weight) @ (slope - mean)
        means.append(mean)
        weights.append(periodogram.weight.sum())
    extrapolation = slopes(np.array([NOISE.long_run_frequency]))[0] - np.average(means, axis=0, weights=weights)
    if best == (0.0, 0.0):  # both slopes are the same: one direction is left, phi + theta
        return float(extrapolation[0] ** 2 / max(information[0, 0], 1e-300))
    values, vectors = np.linalg.eigh(information + 1.0 * np.eye(2))  # phi and theta are below 1 in size
    return float(np.sum((vectors.T @ extrapolation) ** 2 / values))
