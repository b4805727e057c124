"""The paper's own way: a formula for necking (A-1), sines through what it leaves, and the same for the rate."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from itertools import product
from typing import TYPE_CHECKING, Literal

import numpy as np
from scipy.integrate import cumulative_simpson
from scipy.optimize import least_squares

from probation.errors import InputError
from probation.histories.necking import NECKING_SETS, NeckingHistory
from probation.settings.smoothing import SMOOTHING
from probation.smoothing.differences import NAME, differences, differences_error, differences_transposed
from probation.smoothing.operators import Operators
from probation.smoothing.sines import Sines, fit_sines
from probation.smoothing.smoothed import Smoothed, inflation

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray

Signal = Literal["strain", "rate"]

REFINED = 4
"""Starts that are refined, of all that are tried."""


@dataclass(frozen=True, eq=False)
class TwoSteps:
    """(A-1), or its derivative, through a signal; then sines through what it leaves.

    Attributes
    ----------
    signal : {"strain", "rate"}
    time : ndarray, shape (n_times,) [s]
    measured : ndarray, shape (n_times,) [- or 1/s]
    weights : ndarray, shape (n_times,)
        One over the noise of each sample, up to a factor.
    history : NeckingHistory
        The first step; its time starts at the record's start.
    offset : float [-]
        Of the measured strain where (A-1) starts at zero; 0 for a rate.
    sines : Sines
        The second step.
    """

    signal: Signal
    time: FloatArray
    measured: FloatArray
    weights: FloatArray
    history: NeckingHistory
    offset: float
    sines: Sines

    @cached_property
    def first(self) -> FloatArray:
        """The fit after the first step, shape (n_times,)."""
        return _formula(self.signal, self.history, self.time - self.time[0]) + self.offset

    @cached_property
    def final(self) -> FloatArray:
        """The fit after both steps, shape (n_times,)."""
        return self.first + self.sines(self.time)

    @property
    def first_residual(self) -> FloatArray:
        """Measured - fit after the first step."""
        return self.measured - self.first

    @property
    def final_residual(self) -> FloatArray:
        """Measured - fit after both steps."""
        return self.measured - self.final

    @property
    def freedom(self) -> int:
        """Parameters of both steps."""
        return 4 + (self.signal == "strain") + 3 * len(self.sines.frequencies)

    def linearised(self) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Gauss-Newton: the fit moves by ``left @ right @ change`` when the samples do.

        Where two sines of nearly one frequency all but cancel, this is rough: their fit hardly knows where to settle.

        Returns
        -------
        left : ndarray, shape (n_times, p)
        left_slopes : ndarray, shape (n_times, p)
            Of its derivative by time, for a strain.
        right : ndarray, shape (p, n_times)
        """
        jacobian, slopes = self._formula_jacobian()
        robust = self.weights
        if self.signal == "strain":
            size = float(np.median(np.abs(robust * self.first_residual))) or 1.0
            robust = robust / (1.0 + (robust * self.first_residual / (SMOOTHING.necking_outlier * size)) ** 2) ** 0.25
        first = np.linalg.pinv(robust[:, None] * jacobian, rcond=1e-10) * robust
        if not len(self.sines.frequencies):
            return jacobian, slopes, first
        waves, wave_slopes = self.sines.jacobian(self.time)
        second = np.linalg.pinv(self.weights[:, None] * waves, rcond=1e-8) * self.weights
        return (
            np.hstack([jacobian, waves]),
            np.hstack([slopes, wave_slopes]),
            np.vstack([first, second - (second @ jacobian) @ first]),
        )

    def _formula_jacobian(self) -> tuple[FloatArray, FloatArray]:
        """Derivatives of the first step and of its slope along its parameters, each (n_times, 4 or 5)."""
        t = self.time - self.time[0]
        values, slopes = [], []
        for name in ("a", "b", "c", "d"):
            value = getattr(self.history, name)
            step = 1e-5 * min(abs(value), 1.0 - value if name == "c" else np.inf)
            sides = [_with(self.history, **{name: value + side * step}) for side in (1.0, -1.0)]
            ahead, behind = (_formula(self.signal, side, t) for side in sides)
            values.append((ahead - behind) / (2.0 * step))
            ahead, behind = (side.strain_rate(t) for side in sides)
            slopes.append((ahead - behind) / (2.0 * step))
        if self.signal == "strain":
            values.append(np.ones_like(t))
            slopes.append(np.zeros_like(t))
        return np.column_stack(values), np.column_stack(slopes)


@dataclass(frozen=True, eq=False)
class NeckingFit:
    """The supplementary procedure on one record, Figures S3 to S8.

    Attributes
    ----------
    rate : TwoSteps
        Through the measured strain's differences.
    differentiator : str
        What they are.
    integrated : ndarray, shape (n_times,) [-]
        The fitted rate integrated from the fitted strain's start: the check of Figure S8.
    """

    strain: TwoSteps
    rate: TwoSteps
    differentiator: str
    integrated: FloatArray

    @property
    def strain_slope(self) -> FloatArray:
        """The derivative of the strain's own fit, shape (n_times,) [1/s]."""
        time, steps = self.strain.time, self.strain
        return steps.history.strain_rate(time - time[0]) + steps.sines.derivative(time)

    @property
    def largest_drift(self) -> float:
        """Largest distance between the integrated rate and the measured strain [-]."""
        return float(np.abs(self.integrated - self.strain.measured).max())


def fit_necking(time: FloatArray, true_strain: FloatArray) -> NeckingFit:
    """Fit strain and rate of a necking specimen by the paper's procedure.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]

    Raises
    ------
    InputError
        If the record is short, comes back, is strained at a nearly constant rate, or (A-1) does not describe it.

    References
    ----------
    André et al., supplementary information, "Curve fitting process for the command/excitation signal", eq. (A-1).
    """
    return _fitted(np.ascontiguousarray(time).tobytes(), np.ascontiguousarray(true_strain).tobytes())


@lru_cache(maxsize=2)
def _fitted(time_bytes: bytes, strain_bytes: bytes) -> NeckingFit:
    """`fit_necking`, remembered: strain and rate, figures and tables all ask for the same fit."""
    time, true_strain = np.frombuffer(time_bytes), np.frombuffer(strain_bytes)
    _check(time, true_strain)
    strain = _two_steps("strain", time, true_strain, np.ones_like(time), None)
    extent = float(np.ptp(true_strain))
    missed = float(np.sqrt(np.mean(strain.first_residual**2)))
    if missed > SMOOTHING.necking_misfit * extent:
        raise InputError(
            f"(A-1) misses the strain by {missed:.2g} (rms), {100 * missed / extent:.1f} % of its range; "
            f"expected a necking record that it describes to {100 * SMOOTHING.necking_misfit:.0f} %"
        )
    rates = strain.history.strain_rate(time - time[0])
    ratio = float(rates.max() / max(float(rates.min()), 1e-300))
    if ratio < SMOOTHING.necking_rates:
        raise InputError(
            f"found a strain rate that changes by a factor of {ratio:.3g} only, expected necking "
            f"({SMOOTHING.necking_rates} or more), which (A-1) describes"
        )
    measured = differences(time, true_strain)
    rate = _two_steps("rate", time, measured, 1.0 / differences_error(time), strain.history)
    integrated = strain.final[0] + cumulative_simpson(rate.final, x=time, initial=0.0)
    return NeckingFit(strain, rate, NAME, integrated)


def smooth_necking(time: FloatArray, true_strain: FloatArray) -> Smoothed:
    """Strain by both steps of `fit_necking`, rate by its derivative.

    Closer to the true rate than a fit of the differentiated strain, whose slow part telescopes to the outermost
    samples, whatever was measured in between, and whose noise hides the sines; docs/excitation.md has the figures.
    """
    fit = fit_necking(time, true_strain)
    left, slopes, right = fit.strain.linearised()
    return _smoothed(fit, left, right, fit.strain_slope, slopes, right)


def smooth_necking_as_printed(time: FloatArray, true_strain: FloatArray) -> Smoothed:
    """Strain and rate each by their own fit, as in the paper."""
    fit = fit_necking(time, true_strain)
    left, _, right = fit.strain.linearised()
    rate_left, _, rate_right = fit.rate.linearised()
    return _smoothed(fit, left, right, fit.rate.final, rate_left, differences_transposed(time, rate_right))


def _smoothed(
    fit: NeckingFit,
    left: FloatArray,
    right: FloatArray,
    rate: FloatArray,
    rate_left: FloatArray,
    rate_right: FloatArray,
) -> Smoothed:
    grown = inflation(fit.strain.final_residual)
    return Smoothed(
        fit.strain.final,
        rate,
        np.sqrt(grown) * _norms(left, right),
        np.sqrt(grown) * _norms(rate_left, rate_right),
        float(fit.strain.freedom),
        float(np.sum(fit.strain.final_residual**2)),
        grown,
        lambda: Operators(left @ right, rate_left @ rate_right),
    )


def _norms(left: FloatArray, right: FloatArray) -> FloatArray:
    """Norms of the rows of ``left @ right``."""
    squares: FloatArray = np.einsum("ip,pq,iq->i", left, right @ right.T, left)
    return np.sqrt(np.maximum(squares, 0.0))


def _check(time: FloatArray, true_strain: FloatArray) -> None:
    if len(time) < SMOOTHING.fewest_for_necking:
        raise InputError(
            f"found {len(time)} samples, expected {SMOOTHING.fewest_for_necking} or more for (A-1) and sines"
        )
    extent = float(np.ptp(true_strain))
    back = float(np.max(np.maximum.accumulate(true_strain) - true_strain))
    if back > SMOOTHING.necking_return * extent:
        raise InputError(
            f"found a strain that comes back by {back:.2g}, expected the rising strain of a necking specimen, "
            "which (A-1) describes"
        )


def _two_steps(
    signal: Signal, time: FloatArray, measured: FloatArray, weights: FloatArray, near: NeckingHistory | None
) -> TwoSteps:
    history, offset = _fit_formula(signal, time - time[0], measured, weights, near)
    first = _formula(signal, history, time - time[0]) + offset
    return TwoSteps(
        signal, time, measured, weights, history, offset, fit_sines(time, measured - first, weights / np.mean(weights))
    )


def _fit_formula(
    signal: Signal, t: FloatArray, measured: FloatArray, weights: FloatArray, near: NeckingHistory | None
) -> tuple[NeckingHistory, float]:
    """The first step, b and the offset by linear least squares within: (A-1) is linear in them.

    The strain's is robust. The rate's is not: the noise of neighbouring differences cancels in plain least squares, and
    a robust loss, which weighs each by itself, would spoil that (by a factor of 6 in the error of the rate).
    """
    duration = float(t[-1])

    def solved(x: FloatArray) -> tuple[NeckingHistory, float, FloatArray]:
        unit = NeckingHistory(a=-np.exp(x[0]), b=1.0, c=1.0 / (1.0 + np.exp(-x[1])), d=np.exp(x[2]), duration=duration)
        columns = [_formula(signal, unit, t)] + ([np.ones_like(t)] if signal == "strain" else [])
        design = weights[:, None] * np.column_stack(columns)
        coefficients = np.linalg.lstsq(design, weights * measured, rcond=None)[0]
        offset = float(coefficients[1]) if signal == "strain" else 0.0
        return _with(unit, b=float(coefficients[0])), offset, design @ coefficients - weights * measured

    def residual(x: FloatArray) -> FloatArray:
        return solved(x)[2] / size

    starts = _starts(duration) if near is None else [_unbounded(near)]
    size = float(np.ptp(weights * measured))
    best = sorted(starts, key=lambda x: float(np.sum(residual(x) ** 2)))[:REFINED]
    limits = ([-np.inf, -8.0, -12.0], [np.inf, 8.0, 30.0])
    minimum = min((least_squares(residual, x, bounds=limits) for x in best), key=lambda fitted: fitted.cost)
    size *= max(float(np.median(np.abs(minimum.fun))), 1e-12)  # a second time, outliers held at bay
    loss: Literal["soft_l1", "linear"] = "soft_l1" if signal == "strain" else "linear"
    minimum = least_squares(
        residual,
        minimum.x,
        bounds=limits,
        loss=loss,
        f_scale=SMOOTHING.necking_outlier,
        ftol=1e-13,
        xtol=1e-13,
        gtol=1e-13,
    )
    history, offset, _ = solved(minimum.x)
    return history, offset


def _starts(duration: float) -> list[FloatArray]:
    """The paper's experiments at this duration, and around them."""
    base = [necking.slowed(duration / necking.duration) for necking in NECKING_SETS.values()]
    return [
        _unbounded(_with(history, a=history.a * sharper, d=history.d * deeper))
        for history, sharper, deeper in product(base, (0.5, 1.0, 2.0, 4.0), (0.1, 0.4, 1.0, 3.0))
    ]


def _unbounded(history: NeckingHistory) -> FloatArray:
    return np.array([np.log(-history.a), np.log(history.c / (1.0 - history.c)), np.log(history.d)])


def _with(history: NeckingHistory, **changes: float) -> NeckingHistory:
    values = {name: getattr(history, name) for name in ("a", "b", "c", "d", "duration")}
    return NeckingHistory(**{**values, **changes})


def _formula(signal: Signal, history: NeckingHistory, t: FloatArray) -> FloatArray:
    evaluate: Callable[[FloatArray], FloatArray] = history.true_strain if signal == "strain" else history.strain_rate
    return evaluate(t)
