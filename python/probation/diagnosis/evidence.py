r"""How probable the data are under an explanation: Laplace's integral, with allowance for the form of an effect.

A catalogue's form of an effect is never quite nature's. Taken at their word, two explanations that leave 40 and 60
MPa^2 of a gap of 10 000 would differ by hundreds of log units; taken as forms known to some per cent, both have found
nearly all of it. So what an explanation leaves is let be noise plus a smooth discrepancy,

    y ~ N(J d, I + B D B^T),

y the whitened residual, J the whitened Jacobian, d the parameters' distance from the optimum with their prior, B smooth
waves over every record and D = rho^2 lambda_r v the discrepancy's variance: rho the relative error of a form, lambda_r
what the explanation does to record r, v the spectrum of smooth curves. rho is integrated out; errors of a form that are
alike in all records (`form_columns`) stand among the parameters. "Unknown" is the same with nothing but a discrepancy,
of any size (Kennedy & O'Hagan 2001; gap-method sections 4 and 7).
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import erfcx, log_ndtr, logsumexp

from probation.gap.smooth_basis import smooth_basis

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.diagnosis.refit import Refit
    from probation.gap.whitening import Whitened

FORM_ERRORS = (0.0, 0.01, 0.02, 0.04, 0.08)
FORM_WEIGHTS = (0.4, 0.2, 0.2, 0.12, 0.08)
"""Relative errors of a form, and how probable they are beforehand."""

SIZES = tuple((10.0 ** np.arange(0.5, 9.0, 0.25)).tolist())
"""Squared sizes of an unknown effect in one record, in units of the noise's variance per wave; log-uniform."""

SOFTNESS = (2.0, 1.0)
"""The spectrum of a discrepancy falls with the order of its waves to these powers, half of its energy each."""

ROUGHEST = 24
"""Half periods per record up to which a discrepancy is looked for."""

DEPENDENT = 1e-4
"""Part of a wave that smoother ones leave, below which it adds nothing."""


@dataclass(frozen=True, eq=False)
class Discrepancy:
    """Smooth waves over every record, whitened and orthonormal, and the spectrum of a discrepancy along them.

    Attributes
    ----------
    columns : tuple of ndarray, shape (n_r, d_r)
        By record.
    spectrum : tuple of ndarray, shape (d_r,)
        Shares of the waves in a discrepancy's energy; sum to 1 in each record.
    slices : tuple of slice
        Rows of each record.
    places : tuple of slice
        Its waves among all.
    """

    columns: tuple[FloatArray, ...]
    spectrum: tuple[FloatArray, ...]
    slices: tuple[slice, ...]
    places: tuple[slice, ...]

    @classmethod
    def of(cls, whitened: Whitened) -> Discrepancy:
        """Of the identify records."""
        columns, spectrum, places, at = [], [], [], 0
        for record, noise in zip(whitened.records, whitened.noises, strict=True):
            basis = smooth_basis(record.time, record.jumps, ROUGHEST)
            left, upper = np.linalg.qr(noise.whiten(basis.columns / np.linalg.norm(basis.columns, axis=0)))
            size = np.abs(np.diag(upper))
            kept = size > DEPENDENT * float(size.max())
            falls = [(1.0 + basis.order[kept]) ** -power for power in SOFTNESS]
            columns.append(left[:, kept])
            spectrum.append(np.mean([share / share.sum() for share in falls], axis=0))
            places.append(slice(at, at + int(kept.sum())))
            at = places[-1].stop
        return cls(tuple(columns), tuple(spectrum), whitened.slices, tuple(places))

    def __len__(self) -> int:
        return int(self.places[-1].stop)

    def of_columns(self, matrix: FloatArray) -> FloatArray:
        """B^T times whitened columns (N,) or (N, m)."""
        return np.concatenate([own.T @ matrix[part] for own, part in zip(self.columns, self.slices, strict=True)])

    def energy(self, values: FloatArray) -> FloatArray:
        """Energy of whitened samples (N,) by record, shape (n_records,)."""
        return np.array([float(values[part] @ values[part]) for part in self.slices])

    def variances(self, energy: FloatArray) -> FloatArray:
        """D for a discrepancy of so much energy in each record, shape (d,)."""
        parts = [size * share for size, share in zip(energy, self.spectrum, strict=True)]
        return np.asarray(np.concatenate(parts), dtype=np.float64)

    def factor(self, energy: FloatArray) -> FloatArray:
        """B D^(1/2) for a discrepancy of so much energy in each record, shape (N, d)."""
        columns = np.zeros((self.slices[-1].stop, len(self)))
        size = np.sqrt(self.variances(energy))
        for own, part, place in zip(self.columns, self.slices, self.places, strict=True):
            columns[part, place] = own * size[place]
        return columns


@dataclass(frozen=True, eq=False)
class Evidence:
    """What the data say of one explanation.

    Attributes
    ----------
    log_evidence : float
        Up to a constant that all explanations of a campaign share.
    form_error : float
        Posterior mean of the relative error of its form.
    log_evidence_unknown : float
        With an effect outside the catalogue beside it.
    covariance : ndarray, shape (p, p)
        Of the search coordinates, the form's error included; parameters at a bound have none.
    log_evidence_exact : float
        If its form were exact: what tells the forms of one effect apart.
    """

    log_evidence: float
    form_error: float
    log_evidence_unknown: float
    covariance: FloatArray
    log_evidence_exact: float = -np.inf


def evidence(
    found: Refit,
    base: Refit,
    discrepancy: Discrepancy,
    *,
    forms: FloatArray | None = None,
    unknown: bool = True,
) -> Evidence:
    """Evidence of an explanation, or of the base law itself.

    Parameters
    ----------
    found : Refit
    base : Refit
        Of the base law without causes.
    discrepancy : Discrepancy
    forms : ndarray, shape (N, m), optional
        Ways in which the forms may be wrong, of one standard deviation each; see `form_columns`.
    unknown : bool
        Whether an unknown effect beside it is looked for, too; else its evidence is -inf.
    """
    problem = _Problem.of(found, discrepancy, forms)
    done = discrepancy.energy(found.residual - base.residual)
    errors = FORM_ERRORS if found.model.causes else (0.0,)
    weights = FORM_WEIGHTS if found.model.causes else (1.0,)
    scores = [
        problem.log_integral(discrepancy.variances(error**2 * done)) + float(np.log(weight))
        for error, weight in zip(errors, weights, strict=True)
    ]
    together = float(logsumexp(scores))
    posterior = np.exp(np.array(scores) - together)
    form_error = float(posterior @ np.array(errors))
    covariance = problem.covariance(discrepancy.variances(form_error**2 * done))
    beside = _unknown(problem, discrepancy) if unknown else -np.inf
    exact = problem if forms is None else _Problem.of(found, discrepancy)
    plain = exact.log_integral(discrepancy.variances(0.0 * done))
    return Evidence(together, form_error, beside, covariance, plain)


def _unknown(problem: _Problem, discrepancy: Discrepancy) -> float:
    """With a discrepancy of any size in any record: coordinate ascent over the records' sizes, each paid for."""
    count = len(discrepancy.spectrum)
    # A start record by record: the waves' power over what a unit of energy would give them.
    waves = problem.waves_of_residual
    energy = np.array(
        [max(float(np.sum(waves[place] ** 2)) - (place.stop - place.start), 0.0) for place in discrepancy.places]
    )
    grid = np.array(SIZES)
    best = energy.copy()
    score = problem.log_integral(discrepancy.variances(best))
    for _ in range(2):
        before = score
        for index in range(count):
            for size in (0.0, *(grid[np.argsort(np.abs(np.log(grid / max(best[index], 1.0))))[:5]])):
                tried = best.copy()
                tried[index] = size
                value = problem.log_integral(discrepancy.variances(tried))
                if value > score:
                    best, score = tried, value
        if score - before < 0.1:
            break
    return float(score - count * np.log(len(SIZES) / 3.0))


@dataclass(frozen=True, eq=False)
class _Problem:
    """The linearised problem in the few numbers that the integral needs."""

    square: float
    gradient: FloatArray
    normal: FloatArray
    waves_of_residual: FloatArray
    waves_of_jacobian: FloatArray
    away: FloatArray
    precision: FloatArray
    log_prior: float
    bound_factor: float
    free: NDArray[np.bool_]
    below: FloatArray
    above: FloatArray

    @classmethod
    def of(cls, found: Refit, discrepancy: Discrepancy, forms: FloatArray | None = None) -> _Problem:
        model, coordinates = found.model, found.coordinates
        x = coordinates.of(found.parameters)
        jacobian, residual = found.jacobian, found.residual
        gradient = jacobian.T @ residual + coordinates.precision * (x - coordinates.centre)
        effects = np.arange(len(x)) >= model.base_count
        free = ~(coordinates.pushed_out(x, gradient) & effects)
        inside = jacobian[:, free]
        # A flat prior ends at its bounds, or after a period: a wide normal one around x, cut there, stands in for it.
        below, above = x - coordinates.lower, coordinates.upper - x
        period = np.append(np.zeros(model.base_count), [each.period for each in model.effect_parameters])
        below, above = (
            np.where(effects, np.where(period > 0.0, 0.5 * period, room), np.inf) for room in (below, above)
        )
        flat = effects & (coordinates.precision == 0.0)
        centre = np.where(flat, x, coordinates.centre)
        precision = np.where(flat, (below + above) ** -2.0, coordinates.precision)
        normal_part = -0.5 * coordinates.precision * (x - coordinates.centre) ** 2
        # Beside the parameters stand the errors of their forms, standard normal; their integral is a marginal density.
        more = np.zeros((len(residual), 0)) if forms is None else forms
        count = more.shape[1]
        inside = np.hstack([inside, more])
        return cls(
            square=float(residual @ residual),
            gradient=-(inside.T @ residual),
            normal=inside.T @ inside,
            waves_of_residual=-discrepancy.of_columns(residual),
            waves_of_jacobian=discrepancy.of_columns(inside),
            away=np.append((centre - x)[free], np.zeros(count)),
            precision=np.append(precision[free], np.ones(count)),
            # Normalisation of the priors and, held at a bound, their value there.
            log_prior=model.log_prior(found.parameters)
            - float(np.sum(normal_part[free]))
            - 0.5 * count * float(np.log(2.0 * np.pi)),
            bound_factor=_at_bounds(jacobian, precision, np.abs(gradient), free, below + above),
            free=free,
            below=np.append(below[free], np.full(count, np.inf)),
            above=np.append(above[free], np.full(count, np.inf)),
        )

    def log_integral(self, variances: FloatArray) -> float:
        """Log of the integral over the parameters of likelihood times prior, C = I + B D B^T."""
        shrink = variances / (1.0 + variances)
        inside, own = self.waves_of_jacobian, self.waves_of_residual
        normal = self.normal - inside.T @ (shrink[:, None] * inside)
        gradient = self.gradient - inside.T @ (shrink * own)
        square = self.square - float(own @ (shrink * own))
        total = normal + np.diag(self.precision)
        pull = gradient + self.precision * self.away
        size = np.sqrt(np.maximum(np.diag(total), 1e-300))
        values, vectors = np.linalg.eigh(total / np.outer(size, size))
        values = np.maximum(values, 1e-14)
        turned = vectors.T @ (pull / size)
        step = (vectors @ (turned / values)) / size
        quadratic = square + float(self.precision @ self.away**2) - float(turned @ (turned / values))
        deviation = np.sqrt(np.einsum("ij,j->i", vectors**2, 1.0 / values)) / size
        cut = float(np.sum(_log_inside(-(self.below + step) / deviation, (self.above - step) / deviation)))
        log_determinant = float(np.sum(np.log(values)) + 2.0 * np.sum(np.log(size)))
        return (
            -0.5 * quadratic
            - 0.5 * float(np.sum(np.log1p(variances)))
            - 0.5 * log_determinant
            + 0.5 * len(values) * float(np.log(2.0 * np.pi))
            + self.log_prior
            + self.bound_factor
            + cut
        )

    def covariance(self, variances: FloatArray) -> FloatArray:
        """Of all search coordinates; zero for those at a bound."""
        inside, prior = self.waves_of_jacobian, np.diag(self.precision)
        inverse = np.linalg.pinv(self.normal + prior, hermitian=True)
        # The discrepancy widens what the estimate, made without it, scatters by.
        own = inverse @ (self.normal + inside.T @ (variances[:, None] * inside) + prior) @ inverse
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
