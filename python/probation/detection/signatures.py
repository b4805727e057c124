"""Parameters that will not hold still: refits per record, and estimates on ever more of a record."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtr

from probation.detection.tail import chi_square_tail, family_p_value, normal_tail

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened

CHECKPOINTS = 32


@dataclass(frozen=True, eq=False)
class Drift:
    """One parameter refitted to every record, the others shared.

    Attributes
    ----------
    parameter : str
    change, se : dict of str to float
        By record, from the common value; in the parameter's unit. Records that do not determine it are left out.
    heterogeneity_p_value : float
        That all records want the same value (Cochran's Q).
    slope_p_value : dict of str to float
        That the changes have no slope along a covariate ("log_rate", "order", ...), by the noise alone.
    scatter_p_value : dict of str to float
        That records which differ at random would show such a slope: Student's test against their scatter about it.
    slope : dict of str to float
        Change of the parameter per unit of the covariate.
    """

    parameter: str
    change: Mapping[str, float]
    se: Mapping[str, float]
    heterogeneity_p_value: float
    slope_p_value: Mapping[str, float]
    scatter_p_value: Mapping[str, float]
    slope: Mapping[str, float]


@dataclass(frozen=True, eq=False)
class Sequential:
    """Estimates of one parameter on ever more of a record (Beck); flat if the law is right.

    Attributes
    ----------
    record, parameter : str
    time : ndarray, shape (k,) [s]
        Up to which samples were taken.
    change, se : ndarray, shape (k,)
        From the estimate on the whole record, and its standard error by noise alone; nan where not yet determined.
    p_value : float
        That it is flat: the largest change in standard errors against its distribution under noise.
    """

    record: str
    parameter: str
    time: FloatArray
    change: FloatArray
    se: FloatArray
    p_value: float


def parameter_drift(
    whitened: Whitened, names: Sequence[str], covariates: Mapping[str, Sequence[float]] | None = None
) -> tuple[Drift, ...]:
    """Refit one parameter at a time to every record, in linearised form (docs/diagnosis-method.md, section 3).

    Parameters
    ----------
    whitened : Whitened
    names : sequence of str
        Of the tangent's columns.
    covariates : dict of str to sequence of float, optional
        One number per record; by default "log_rate" (median of the moving samples) and "order".

    Returns
    -------
    tuple of Drift
    """
    records, count = whitened.records, len(whitened.records)
    tangent = whitened.whiten([record.tangent for record in records])
    residual = np.concatenate([noise.whiten(whitened.clean(index)) for index, noise in enumerate(whitened.noises)])
    along = dict(covariates) if covariates is not None else usual_covariates(whitened)
    found = []
    for column, name in enumerate(names):
        own = np.zeros((len(whitened), count))
        for index, part in enumerate(whitened.slices):
            own[part, index] = tangent[part, column]
        design = np.hstack([own, np.delete(tangent, column, axis=1)])
        size = np.linalg.norm(design, axis=0)
        used = size > 0.0
        left, upper = np.linalg.qr(design[:, used] / size[used])
        inverse = np.linalg.pinv(upper, rcond=1e-9) / size[used][:, None]
        estimate, covariance = np.zeros(len(size)), np.full((len(size), len(size)), np.nan)
        estimate[used] = -inverse @ (left.T @ residual)  # model minus data: the step that closes the gap
        covariance[np.ix_(used, used)] = inverse @ inverse.T
        known = np.flatnonzero(used[:count] & (np.diag(covariance)[:count] > 0.0))
        value, spread = estimate[known], covariance[np.ix_(known, known)]
        weight = np.linalg.pinv(spread, hermitian=True)
        common = float(weight.sum(axis=0) @ value / weight.sum()) if known.size else 0.0
        away = value - common
        level = whitened.scale_spread
        q_value = float(away @ weight @ away)
        heterogeneity = float(chi_square_tail(q_value, known.size - 1, level)) if known.size > 1 else 1.0
        slopes, p_values, scattered = {}, {}, {}
        for label, numbers in along.items():
            place = np.asarray([float(x) for x in numbers])[known]
            if known.size < 2 or np.ptp(place) == 0.0:
                continue
            columns = np.column_stack([np.ones(known.size), place])
            normal = np.linalg.pinv(columns.T @ weight @ columns, hermitian=True)
            slope = float((normal @ (columns.T @ weight @ value))[1])
            slopes[label] = slope
            p_values[label] = float(2.0 * normal_tail(abs(slope) / np.sqrt(max(normal[1, 1], 1e-300)), level))
            scattered[label] = _chance_among_scattered(place, value, np.diag(spread))
        ids = [records[int(i)].name for i in known]
        found.append(
            Drift(
                name,
                dict(zip(ids, away.tolist(), strict=True)),
                dict(zip(ids, np.sqrt(np.diag(spread)).tolist(), strict=True)),
                heterogeneity,
                p_values,
                scattered,
                slopes,
            )
        )
    return tuple(found)


def sequential_estimates(
    whitened: Whitened, names: Sequence[str], *, size: int = 2000, seed: int = 0
) -> tuple[Sequential, ...]:
    """Estimates on the first k samples of each record alone, in linearised form, and whether they are flat (Beck).

    Parameters
    ----------
    whitened : Whitened
    names : sequence of str
        Of the tangent's columns.
    size : int
        Draws of the noise for the largest change's distribution.
    seed : int
    """
    rng = np.random.default_rng(seed)
    found = []
    for index, (record, noise) in enumerate(zip(whitened.records, whitened.noises, strict=True)):
        tangent = noise.whiten(record.tangent)
        scale = np.linalg.norm(tangent, axis=0)
        scale[scale == 0.0] = 1.0
        tangent = tangent / scale
        residual = noise.whiten(whitened.clean(index))
        ends = np.unique(np.linspace(len(record) / CHECKPOINTS, len(record), CHECKPOINTS).round().astype(int))
        starts = np.concatenate([[0], ends[:-1]])
        cells = [tangent[first:stop] for first, stop in zip(starts, ends, strict=True)]
        pieces = np.array([cell.T @ cell for cell in cells])
        information = np.cumsum(pieces, axis=0)
        scores = np.cumsum(
            [-cell.T @ residual[first:stop] for cell, first, stop in zip(cells, starts, ends, strict=True)], axis=0
        )
        fine = np.linalg.cond(information) < 1e8
        if not fine[-1]:
            continue
        usable = np.flatnonzero(fine)
        inverse = np.linalg.inv(information[usable])
        variance = np.diagonal(inverse - inverse[-1], axis1=1, axis2=2)
        error = np.sqrt(np.maximum(variance, 1e-300))
        change = np.einsum("kij,kj->ki", inverse, scores[usable])
        change = change - change[-1]
        values, vectors = np.linalg.eigh(pieces)
        root = vectors * np.sqrt(np.maximum(values, 0.0))[:, None, :]
        noise_scores = np.einsum("kij,skj->ski", root, rng.standard_normal((size, len(cells), tangent.shape[1])))
        drawn = np.einsum("kij,skj->ski", inverse, np.cumsum(noise_scores, axis=1)[:, usable])
        drawn = drawn - drawn[:, -1:]
        level = 0.5 * float(np.sqrt(noise.level_variance + noise.shape_variance))
        sized = np.exp(level * rng.standard_normal(size))[:, None]
        # A checkpoint near the end has next to no room to differ: its ratio is left out.
        roomy = variance > 1e-6 * np.diagonal(inverse, axis1=1, axis2=2)
        for column, name in enumerate(names):
            take = roomy[:, column]
            if not take.any():
                continue
            ratio = np.max(np.abs(change[take, column] / error[take, column]))
            null = np.max(np.abs(drawn[:, take, column] / error[take, column]), axis=1) * sized[:, 0]
            p_value = float(family_p_value(normal_tail(float(ratio), level), normal_tail(null, level)))
            moved, deviation = np.full(len(ends), np.nan), np.full(len(ends), np.nan)
            moved[usable], deviation[usable] = change[:, column] / scale[column], error[:, column] / scale[column]
            found.append(Sequential(record.name, name, record.time[ends - 1], moved, deviation, p_value))
    return tuple(found)


def usual_covariates(whitened: Whitened) -> dict[str, Sequence[float]]:
    """What a parameter may change with: "log_rate" (median of the moving samples) and "order", one number a record."""
    return {"log_rate": _log_rates(whitened), "order": range(len(whitened.records))}


def _chance_among_scattered(place: FloatArray, value: FloatArray, variance: FloatArray) -> float:
    """Chance of such a slope where values differ at random, too, by Student's t; 1 for fewer than three values.

    Parameters
    ----------
    place, value : ndarray, shape (n,)
        Of the covariate, and of the parameter.
    variance : ndarray, shape (n,)
        Of the values, by noise; what they scatter beyond it about the line comes on top.
    """
    freedom = len(value) - 2
    if freedom < 1:
        return 1.0
    design = np.column_stack([np.ones(len(value)), place - place.mean()])
    left = value - design @ np.linalg.lstsq(design, value, rcond=None)[0]
    total = variance + max(float(left @ left) / freedom - float(variance.mean()), 0.0)
    weighted = design / np.sqrt(total)[:, None]
    normal = np.linalg.pinv(weighted.T @ weighted, hermitian=True)
    line = normal @ (weighted.T @ (value / np.sqrt(total)))
    spread = float(np.sum((value - design @ line) ** 2 / total)) / freedom
    error = float(np.sqrt(normal[1, 1] * max(spread, 1.0)))
    return 2.0 * float(stdtr(freedom, -abs(line[1]) / max(error, 1e-300)))


def _log_rates(whitened: Whitened) -> list[float]:
    logs = []
    for record in whitened.records:
        speed = np.abs(record.strain_rate[record.phase != 0.0])
        logs.append(float(np.log10(np.median(speed))) if speed.size else 0.0)
    return logs
