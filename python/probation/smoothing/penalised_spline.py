"""Penalised splines: strain and rate without a formula for either, their smoothness chosen by cross-validation."""

from __future__ import annotations

from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import BSpline
from scipy.linalg import cholesky, solve_triangular
from scipy.ndimage import median_filter
from scipy.optimize import minimize_scalar

from probation.settings.smoothing import SMOOTHING
from probation.smoothing.averaging import Averaging
from probation.smoothing.operators import Operators
from probation.smoothing.smoothed import ROUNDS, Smoothed, inflation, polynomial
from probation.smoothing.transient import Transient, WithTransient

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.smoothing.rate_change import RateChange

FEWEST_KNOTS, MOST_KNOTS, ALL_KNOTS = 40, 250, 500
"""... but at least and at most so many; up to `ALL_KNOTS` where the knots themselves are what holds the curve back."""

LEAST_TURNS = 2
"""Rounds in which smoothness and lags settle, at least."""

COARSE = 120
"""Points of the coarse search for the smoothness."""


def smooth_cubic(
    time: FloatArray, true_strain: FloatArray, begins: RateChange | None = None, averaged: float | None = None
) -> Smoothed:
    """Smooth by a cubic spline that penalises the integral of the second derivative's square."""
    return _smooth(time, true_strain, 2, begins, averaged)


def smooth_quintic(
    time: FloatArray, true_strain: FloatArray, begins: RateChange | None = None, averaged: float | None = None
) -> Smoothed:
    """Smooth by a quintic spline that penalises the integral of the third derivative's square.

    Unlike the cubic one it does not pull the rate's slope to zero at either end, nor its peaks down.
    """
    return _smooth(time, true_strain, 3, begins, averaged)


@dataclass(frozen=True, eq=False)
class Basis:
    """The Demmler-Reinsch basis of a penalised spline: orthonormal at the samples, and so is the penalty.

    Attributes
    ----------
    values : ndarray, shape (n_times, n_basis)
    slopes : ndarray, shape (n_times, n_basis) [1/s]
        Their derivatives.
    penalties : ndarray, shape (n_basis,)
        Increasing; the first `order` are zero.
    order : int
        Of the penalised derivative.
    """

    values: FloatArray
    slopes: FloatArray
    penalties: FloatArray
    order: int

    @classmethod
    def of(cls, time: FloatArray, order: int, knots: int) -> Basis:
        """Splines of degree 2 `order` - 1 with that many inner knots, evenly among the samples.

        Where the samples are dense by design, the penalty is as much lighter as the curve may bend faster there:
        (usual spacing)^(2 order - 1).
        """
        degree = 2 * order - 1
        duration = time[-1] - time[0]
        x = (time - time[0]) / duration
        breaks = np.interp(np.linspace(0.0, len(x) - 1.0, knots + 2), np.arange(len(x)), x)
        padded = np.concatenate([np.zeros(degree), breaks, np.ones(degree)])
        every = BSpline(padded, np.eye(len(padded) - degree - 1), degree)
        design = BSpline.design_matrix(x, padded, degree)
        triangle = cholesky((design.T @ design).toarray())
        # Gauss points that integrate the penalty exactly; its square root keeps the digits of stiff splines.
        points, weights = np.polynomial.legendre.leggauss(order)
        half = 0.5 * np.diff(breaks)[:, None]
        at = (0.5 * (breaks[1:] + breaks[:-1])[:, None] + half * points).ravel()
        weight = (half * weights).ravel() * np.interp(at, x, _spacing(x)) ** degree
        root = np.sqrt(weight)[:, None] * every.derivative(order)(at)
        rotated = solve_triangular(triangle, root.T, trans="T").T
        _, singular, turn = np.linalg.svd(rotated, full_matrices=False)
        penalties = singular**2
        penalties[-order:] = 0.0
        coefficients = solve_triangular(triangle, turn[::-1].T)
        apart = (padded[degree + 1 : -1] - padded[1 : -degree - 1])[:, None]
        slopes = BSpline.design_matrix(x, padded[1:-1], degree - 1) @ (degree / apart * np.diff(coefficients, axis=0))
        return cls(design @ coefficients, slopes / duration, penalties[::-1], order)

    def smoothed(self, shrink: FloatArray, columns: FloatArray) -> FloatArray:
        """Columns (n_times, m) smoothed; `shrink`, shape (n_basis,), is what the smoothness leaves of each function."""
        return np.asarray(self.values @ (shrink[:, None] * (self.values.T @ columns)))

    def errors(self, shrink: FloatArray, covariance: FloatArray, joint: WithTransient | None = None) -> Operators:
        """Those of independent errors; `covariance` is that of the weights of the functions, over the noise's."""
        values, vectors = np.linalg.eigh(covariance)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        strain, rate = self.values @ root, self.slopes @ root
        if joint is not None:
            of_start = self.errors_of_start(shrink, joint)
            strain, rate = np.hstack([strain, of_start.strain]), np.hstack([rate, of_start.rate])
        return Operators(strain, rate)

    def errors_of_start(self, shrink: FloatArray, joint: WithTransient) -> Operators:
        """Of the start: of its lags, and of whether there are any.

        The latter is the way to the other answer over the root of twice the log odds against it, or over 1 if that is
        more: the density of a normal distribution falls on that way as the odds do.
        """
        bent = self.bent(shrink, joint)
        errors = Operators(joint.left @ joint.root, bent @ joint.root)
        if joint.doubt is None:
            return errors
        other, odds = joint.doubt
        size = joint.noise * np.sqrt(max(odds, 1.0))
        strain = (other.left @ other.likeliest - joint.left @ joint.likeliest) / size
        rate = (self.bent(shrink, other) @ other.likeliest - bent @ joint.likeliest) / size
        return Operators(np.column_stack([errors.strain, strain]), np.column_stack([errors.rate, rate]))

    def bent(self, shrink: FloatArray, joint: WithTransient) -> FloatArray:
        """What is left of the rates of lags when the curve follows them as far as it may, shape (n_times, n_lags)."""
        return np.asarray(joint.lags.rate - self.slopes @ (shrink[:, None] * (self.values.T @ joint.lags.strain)))

    def operators(self, shrink: FloatArray, joint: WithTransient | None = None) -> Operators:
        """The dense operators, with lags at the start where there are any."""
        right = shrink[:, None] * self.values.T
        strain, rate = self.values @ right, self.slopes @ right
        if joint is not None:
            strain, rate = strain + joint.left @ joint.gain, rate + self.bent(shrink, joint) @ joint.gain
        return Operators(strain, rate)


class Score:
    """Generalised cross-validation (Craven & Wahba 1979) of a penalised spline, over the logarithm of its penalty.

    Every degree of freedom counts `cost` times: `SMOOTHING.prudence` for white noise, more for correlated noise, which
    hides the cost of following it.
    """

    def __init__(self, basis: Basis, values: FloatArray, cost: float) -> None:
        self.basis = basis
        self.cost = min(cost, 0.5 * len(values) / basis.order)  # the stiffest spline can always be paid for
        self.weights = basis.values.T @ values
        self.beyond = float(np.sum((values - basis.values @ self.weights) ** 2))
        inner = basis.penalties[basis.order :]
        self.limits = (float(np.log(1e-3 / inner[-1])), float(np.log(1e5 / inner[0])))

    def shrink(self, log_penalty: float) -> FloatArray:
        """What is left of each basis function, shape (n_basis,)."""
        left: FloatArray = 1.0 / (1.0 + np.exp(log_penalty) * self.basis.penalties)
        return left

    def squares(self, shrink: FloatArray) -> float:
        """Sum of the squared residuals."""
        return self.beyond + float(np.sum(((1.0 - shrink) * self.weights) ** 2))

    def __call__(self, log_penalty: float) -> float:
        """The score; infinite where the degrees of freedom cost more than there are samples."""
        shrink = self.shrink(log_penalty)
        left = 1.0 - self.cost * float(shrink.sum()) / len(self.basis.values)
        return self.squares(shrink) / left**2 if left > 0.0 else np.inf

    def posterior(self, shrink: FloatArray, variance: float) -> FloatArray:
        r"""Covariance of the functions' weights around those smoothed, over the noise's; shape (n_basis, n_basis).

        Cross-validation cannot see a machine that wanders by less than the noise, and a smoothness says that it does
        not. Here the strain is a trend, of prior variance sigma^2 / (lambda p_k), and a wander of the rate like white
        noise, whose strain falls as the square of the frequency, p_k^(1 / order). Both sizes are averaged over, each
        as the samples speak for it (Wahba 1983 gives the posterior of one size):

        .. math:: C = E[diag(s)] + E[(s - \hat s) w w^T (s - \hat s)] / \sigma^2

        Parameters
        ----------
        shrink : ndarray, shape (n_basis,)
            What the smoother leaves of each function, s-hat.
        variance : float
            Of the noise in slow averages, sigma^2.
        """
        order = self.basis.order
        inner = self.basis.penalties[order:]
        lowest, highest = self.limits
        trend = np.exp(-np.linspace(lowest, highest, SMOOTHING.trends))[:, None] / inner
        wander = np.exp(-np.linspace(lowest, highest, SMOOTHING.wanders) / order)[:, None] / inner ** (1.0 / order)
        prior = (trend[:, None] + wander[None]).reshape(-1, len(inner))
        power = self.weights[order:] ** 2 / variance
        chance = 0.5 * np.sum(power * prior / (1.0 + prior) - np.log1p(prior), axis=1)
        chance = np.exp(chance - chance.max())
        chance /= chance.sum()
        left = np.hstack([np.ones((len(prior), order)), prior / (1.0 + prior)])
        off = (left - shrink) * (self.weights / np.sqrt(variance)) * np.sqrt(chance)[:, None]
        return np.asarray(np.diag(chance @ left) + off.T @ off)

    def best(self) -> FloatArray:
        """`shrink` at the lowest score."""
        grid = np.linspace(*self.limits, COARSE)
        at = int(np.argmin([self(point) for point in grid]))
        ends = (grid[max(at - 1, 0)], grid[min(at + 1, COARSE - 1)])
        minimum = minimize_scalar(self, bounds=ends, method="bounded", options={"xatol": 0.01})
        return self.shrink(float(minimum.x))


def _smooth(
    time: FloatArray, true_strain: FloatArray, order: int, begins: RateChange | None, averaged: float | None
) -> Smoothed:
    count = len(time)
    if count < 4 * order + 2:
        return polynomial(time, true_strain, 1 if count < 6 else 2)
    most = count // 2  # more would leave functions near the ends that no sample determines
    knots = min(most, max(FEWEST_KNOTS, min(count // SMOOTHING.samples_per_knot, MOST_KNOTS)))
    if averaged is None:
        averaged = Averaging.pooled([true_strain]).inflation
    lags = None if begins is None else Transient.after(time, begins)
    smoothed = _with_knots(time, true_strain, order, knots, lags, averaged)
    while smoothed.freedom > SMOOTHING.exhausted * knots and knots < min(most, ALL_KNOTS):
        knots = min(2 * knots, most, ALL_KNOTS)
        finer = _with_knots(time, true_strain, order, knots, lags, averaged)
        if finer.noise > SMOOTHING.better * smoothed.noise:
            break
        smoothed = finer
    return smoothed


def _with_knots(
    time: FloatArray, true_strain: FloatArray, order: int, knots: int, lags: Transient | None, averaged: float
) -> Smoothed:
    """The smoothest spline whose cross-validation knows of the correlation that it leaves in the residual.

    The first round takes the noise as white, or as averaged where that shows beforehand. If it left a correlated
    residual, the spline has begun to follow correlated noise: its degrees of freedom then cost as much more as slow
    averages of that noise scatter more, and so on until both agree. Lags after a start are found with it.
    """
    basis = Basis.of(time, order, knots)
    grown, taken, spent = averaged, np.zeros_like(true_strain), 0.0
    joint: WithTransient | None = None
    for turn in range(ROUNDS):
        score = Score(basis, true_strain - taken, SMOOTHING.prudence * grown)
        shrink = score.best()
        left = true_strain - taken - basis.values @ (shrink * score.weights)
        before, grown = grown, max(grown, inflation(left))
        if lags is not None:
            noise = np.sqrt(grown * float(left @ left) / max(len(left) - float(shrink.sum()) - spent, 1.0))
            joint = WithTransient.of(lags, partial(basis.smoothed, shrink), true_strain, float(noise))
            taken, spent = joint.lags.strain @ joint.likeliest, joint.freedom
        if grown < 1.02 * before and (lags is None or turn >= LEAST_TURNS):
            break
    score = Score(basis, true_strain - taken, SMOOTHING.prudence * grown)
    strain, rate = basis.values @ (shrink * score.weights), basis.slopes @ (shrink * score.weights)
    freedom = float(shrink.sum()) + spent
    noise = grown * float(np.sum((true_strain - strain - taken) ** 2)) / max(len(strain) - freedom, 1.0)
    posterior = score.posterior(shrink, max(noise, SMOOTHING.clean**2))
    # Wahba 1983, Nychka 1988: the posterior variance s^2 S, rather than s^2 S S^T of the noise alone, also covers the
    # bias of a smoother that pulls down peaks, on average along the curve.
    variance, rate_variance = basis.values**2 @ shrink, basis.slopes**2 @ shrink
    if joint is not None:
        strain, rate = strain + taken, rate + joint.lags.rate @ joint.likeliest
        of_start = basis.errors_of_start(shrink, joint)
        variance += np.sum(of_start.strain**2, axis=1)
        rate_variance += np.sum(of_start.rate**2, axis=1)
    return Smoothed(
        strain,
        rate,
        np.sqrt(grown * variance),
        np.sqrt(grown * rate_variance),
        freedom,
        float(np.sum((true_strain - strain) ** 2)),
        grown,
        partial(basis.operators, shrink, joint),
        partial(basis.errors, shrink, posterior, joint),
    )


def _spacing(x: FloatArray) -> FloatArray:
    """The usual spacing around each sample over that of the record, shape (n,).

    Gaps and jitter leave no trace, nor does a change by less than `changed_spacing`.
    """
    step = np.diff(x)
    width = max(2 * int(0.5 * SMOOTHING.spacing_window * len(step)) + 1, 5)
    usual = np.log(median_filter(step, width, mode="nearest") / np.median(step))
    usual = np.sign(usual) * np.maximum(np.abs(usual) - np.log(SMOOTHING.changed_spacing), 0.0)
    spacing: FloatArray = np.exp(np.concatenate([usual[:1], 0.5 * (usual[1:] + usual[:-1]), usual[-1:]]))
    return spacing
