"""Laplace's integral of likelihood times prior over all parameters of an explanation, linearised at its optimum."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky, solve_triangular
from scipy.special import erfcx, log_ndtr

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.inference.discrepancy import Discrepancy
    from probation.inference.refit import Refit

UNDETERMINED = 1e-10
"""Eigenvalue of the normal matrix of unit diagonal below which nothing is known of a direction but rounding."""


@dataclass(frozen=True, eq=False)
class Linearised:
    """The linearised problem in the few numbers that the integral needs."""

    square: float
    gradient: FloatArray
    normal: FloatArray
    waves_of_residual: FloatArray
    waves_of_jacobian: FloatArray
    drift: FloatArray
    away: FloatArray
    precision: FloatArray
    log_prior: float
    bound_factor: float
    form_count: int
    free: NDArray[np.bool_]
    below: FloatArray
    above: FloatArray

    @classmethod
    def of(cls, found: Refit, discrepancy: Discrepancy, forms: FloatArray | None = None) -> Linearised:
        """At a refit's optimum; `forms` (N, m) are columns of further, standard normal amplitudes, which stand last."""
        model, coordinates = found.model, found.coordinates
        x = coordinates.of(found.parameters)
        jacobian, residual = found.jacobian, found.residual
        gradient = jacobian.T @ residual + coordinates.prior.precision * (x - coordinates.prior.centre)
        effects = np.arange(len(x)) >= model.base_count
        free = ~(coordinates.bounds.pushed_out(x, gradient) & effects)
        inside = jacobian[:, free]
        # A flat prior ends at its bounds, or after a period: a wide normal one around x, cut there, stands in for it.
        below, above = x - coordinates.bounds.lower, coordinates.bounds.upper - x
        period = np.append(np.zeros(model.base_count), [parameter.period for parameter in model.effect_parameters])
        below, above = (
            np.where(effects, np.where(period > 0.0, 0.5 * period, room), np.inf) for room in (below, above)
        )
        flat = effects & (coordinates.prior.precision == 0.0)
        centre = np.where(flat, x, coordinates.prior.centre)
        precision = np.where(flat, (below + above) ** -2.0, coordinates.prior.precision)
        normal_part = -0.5 * coordinates.prior.precision * (x - coordinates.prior.centre) ** 2
        # With the parameters, the errors of the forms are integrated over: standard normal amplitudes.
        more = np.zeros((len(residual), 0)) if forms is None else forms
        count = more.shape[1]
        inside = np.hstack([inside, more])
        return cls(
            square=float(residual @ residual),
            gradient=-(inside.T @ residual),
            normal=inside.T @ inside,
            waves_of_residual=-discrepancy.of_columns(residual),
            waves_of_jacobian=discrepancy.of_columns(inside),
            drift=discrepancy.drift,
            away=np.append((centre - x)[free], np.zeros(count)),
            precision=np.append(precision[free], np.ones(count)),
            # Normalisation of the priors and, held at a bound, their value there.
            log_prior=model.log_prior(found.parameters)
            - float(np.sum(normal_part[free]))
            - 0.5 * count * float(np.log(2.0 * np.pi)),
            bound_factor=_at_bounds(jacobian, precision, np.abs(gradient), free, below + above),
            form_count=count,
            free=free,
            below=np.append(below[free], np.full(count, np.inf)),
            above=np.append(above[free], np.full(count, np.inf)),
        )

    def with_last(self, count: int, deviation: float) -> Linearised:
        """The same, the last amplitudes, so many, of another standard deviation than 1."""
        if count == 0:
            return self
        precision = self.precision.copy()
        precision[-count:] = deviation**-2.0
        return replace(self, precision=precision, log_prior=self.log_prior - count * float(np.log(deviation)))

    @property
    def without_forms(self) -> Linearised:
        """The same where the forms are right, of standard normal amplitudes."""
        count = self.form_count
        own = slice(len(self.precision) - count)
        return replace(
            self,
            gradient=self.gradient[own],
            normal=self.normal[own, own],
            waves_of_jacobian=self.waves_of_jacobian[:, own],
            away=self.away[own],
            precision=self.precision[own],
            log_prior=self.log_prior + 0.5 * count * float(np.log(2.0 * np.pi)),
            form_count=0,
            below=self.below[own],
            above=self.above[own],
        )

    def log_integral(self, variances: FloatArray) -> float:
        """Log of the integral over the parameters of likelihood times prior, C = I + B (D + drift) B^T."""
        return float(self.log_integrals(variances[None, :])[0])

    def log_integrals(self, variances: FloatArray, count: int = 0, deviations: FloatArray | float = 1.0) -> FloatArray:
        """The same of several problems at once, shape (m,): the variances D of each stand in a row, shape (m, d).

        In each the last amplitudes, `count` of them, have a standard deviation of their own, shape (m,). One row of
        variances, (1, d), is that of all.
        """
        both, square_of_both = self._waves
        taken, log_root = np.empty((len(variances), *square_of_both.shape)), np.empty(len(variances))
        for index, own in enumerate(variances):
            covariance = self.drift.copy()
            covariance[np.diag_indices_from(covariance)] += 1.0 + own
            lower = cholesky(covariance, lower=True, overwrite_a=True, check_finite=False)
            left = solve_triangular(lower, both, lower=True, check_finite=False)
            taken[index] = square_of_both - left.T @ left
            log_root[index] = np.sum(np.log(np.diag(lower)))
        problems = max(len(variances), np.size(deviations))
        precision = np.repeat(self.precision[None, :], problems, axis=0)
        precision[:, len(self.precision) - count :] = np.asarray(deviations**-2.0)[..., None]
        gradient = self.gradient - taken[:, :-1, -1]
        square = self.square - taken[:, -1, -1]
        diagonal = np.arange(precision.shape[1])
        total = np.repeat(self.normal - taken[:, :-1, :-1], problems // len(variances), axis=0)
        total[:, diagonal, diagonal] += precision
        pull = gradient + precision * self.away
        size = np.sqrt(np.maximum(total[:, diagonal, diagonal], 1e-300))
        values, vectors = np.linalg.eigh(total / (size[:, :, None] * size[:, None, :]))
        # A direction that neither data nor priors know is left where it is: its slope is rounding.
        turned = np.where(values > UNDETERMINED, np.einsum("mij,mi->mj", vectors, pull / size), 0.0)
        values = np.maximum(values, UNDETERMINED)
        step = np.einsum("mij,mj->mi", vectors, turned / values) / size
        quadratic = square + precision @ self.away**2 - np.sum(turned**2 / values, axis=1)
        deviation = np.sqrt(np.einsum("mij,mj->mi", vectors**2, 1.0 / values)) / size
        cut = np.sum(_log_inside(-(self.below + step) / deviation, (self.above - step) / deviation), axis=1)
        log_determinant = np.sum(np.log(values), axis=1) + 2.0 * np.sum(np.log(size), axis=1)
        return np.asarray(
            -0.5 * quadratic
            - log_root
            - 0.5 * log_determinant
            + 0.5 * values.shape[1] * np.log(2.0 * np.pi)
            + self.log_prior
            - count * np.log(deviations)
            + self.bound_factor
            + cut
        )

    @cached_property
    def _waves(self) -> tuple[FloatArray, FloatArray]:
        """The waves of all columns, the residual's last (d, k + 1), and their products (k + 1, k + 1)."""
        both = np.column_stack([self.waves_of_jacobian, self.waves_of_residual])
        return both, both.T @ both

    def covariance(self, variances: FloatArray) -> FloatArray:
        """Of all search coordinates; zero for those at a bound."""
        inside, prior = self.waves_of_jacobian, np.diag(self.precision)
        inverse = np.linalg.pinv(self.normal + prior, hermitian=True)
        # The discrepancy widens what the estimate, made without it, scatters by.
        spread = inside.T @ (self.drift @ inside + variances[:, None] * inside)
        own = inverse @ (self.normal + spread + prior) @ inverse
        full, count = np.zeros((len(self.free), len(self.free))), int(np.count_nonzero(self.free))
        full[np.ix_(self.free, self.free)] = own[:count, :count]
        return full


def _at_bounds(
    jacobian: FloatArray, precision: FloatArray, slope: FloatArray, free: NDArray[np.bool_], room: FloatArray
) -> float:
    """Log of the integrals of exp(-g t - h t^2/2), t the way from the bound, over parameters that are held there.

    g is the objective's slope, h its curvature with the free parameters following.
    """
    if free.all():
        return 0.0
    columns = np.vstack([jacobian, np.diag(np.sqrt(precision))])
    held, inside = columns[:, ~free], columns[:, free]
    size = np.maximum(np.linalg.norm(inside, axis=0), 1e-300)
    seen = held - inside / size @ np.linalg.lstsq(inside / size, held, rcond=1e-10)[0]
    curvature = np.maximum(np.sum(seen**2, axis=0), 1e-300)
    whole = np.sqrt(0.5 * np.pi / curvature) * erfcx(slope[~free] / np.sqrt(2.0 * curvature))
    return float(np.sum(np.log(np.minimum(whole, room[~free]))))


def _log_inside(low: FloatArray, high: FloatArray) -> FloatArray:
    """Log P(low < N(0, 1) < high), in whichever tail has the digits."""
    flip = low > -high
    low, high = np.where(flip, -high, low), np.where(flip, -low, high)
    most = log_ndtr(high)
    return np.asarray(most + np.log1p(-np.exp(log_ndtr(low) - most)))
