"""Parameters that change from record to record: refits per record, and whether they follow a covariate."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtr

from probation.detection.tail import chi_square_tail, normal_tail

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.noise.whitening import Whitened


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
    drifts = []
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
        drifts.append(
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
    return tuple(drifts)


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
