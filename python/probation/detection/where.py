"""Where the gap sits: regions against noise with familywise p-values (docs/diagnosis-method.md, section 3)."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.detection.tail import chi_square_tail, family_p_value
from probation.noise.regions import Kind, Region, state_regions, time_regions
from probation.noise.smooth_basis import smooth_basis
from probation.records.runs import runs
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.noise.record_residual import RecordResidual
    from probation.noise.whitening import Whitened


@dataclass(frozen=True)
class RegionScore:
    """One region of the partitions.

    Attributes
    ----------
    kind : {"time", "strain", "rate", "phase", "record"}
    label : str
    records : tuple of str
    statistic : float
        Chi-square of the region's mean, slope and bend.
    p_value : float
        Familywise: over all regions of all partitions (Westfall & Young, max-T).
    rms_MPa : float
        Of the fit residual there.
    """

    kind: Kind
    label: str
    records: tuple[str, ...]
    statistic: float
    p_value: float
    rms_MPa: float  # noqa: N815


@dataclass(frozen=True)
class Located:
    """One contiguous part of a record in which there is a gap; an entry of the answer's `where`.

    Attributes
    ----------
    record : str
    time_s, true_strain : (float, float)
        First and last instant; smallest and largest strain.
    rms_MPa : float
        Of the fit residual there.
    share : float
        Of the campaign's squared gap, noise set apart; all shares sum to at most 1.
    p_value : float
        Familywise.
    samples : slice
        Of the record.
    """

    record: str
    time_s: tuple[float, float]
    true_strain: tuple[float, float]
    rms_MPa: float  # noqa: N815
    share: float
    p_value: float
    samples: slice


@dataclass(frozen=True)
class Where:
    """Where the gap sits.

    Attributes
    ----------
    located : tuple of Located
        By share, most first; empty where nothing is certain.
    regions : tuple of RegionScore
        Every region that was looked at.
    record_p_value : dict of str to float
        Familywise, each record as a whole or by its worst part.
    """

    located: tuple[Located, ...]
    regions: tuple[RegionScore, ...]
    record_p_value: dict[str, float]

    def by(self, kind: Kind) -> tuple[RegionScore, ...]:
        """Regions of one partition, the least probable first."""
        return tuple(sorted((r for r in self.regions if r.kind == kind), key=lambda r: (r.p_value, -r.statistic)))


def locate(
    whitened: Whitened, *, level: float = DETECTION.region_level, size: int = DETECTION.region_draws, seed: int = 0
) -> Where:
    """Look for the gap region by region (docs/diagnosis-method.md, section 3).

    Partitions: every record in nested intervals of time; all records together by strain, rate and phase. In each region
    the mean, slope and bend of z are tested (a mean where samples are few); familywise p-values come from the draws of
    the largest statistic under the null, the refit that couples all regions included. Contiguous regions of a record
    are then outlined by a smooth curve through its residual, where that is above `DETECTION.outline_errors` standard
    errors and `DETECTION.outline_fraction` of its peak, if a region that is significant by itself lies there.

    A refit smears a gap over places where there was none: `contribution_regions` says where an effect acts once it is
    known.

    Parameters
    ----------
    whitened : Whitened
    level : float
        Familywise.
    size : int
        Draws.
    seed : int
    """
    records = whitened.records
    regions = time_regions(records) + state_regions(records)
    features, places = _features(whitened, regions)
    shared = whitened.span
    products = [
        (feature.T @ whitened.residual[part])[None] for feature, part in zip(features, whitened.slices, strict=True)
    ]
    drawn = whitened.local_draws(features, np.random.default_rng(seed), size)
    metrics: list[FloatArray] = []
    for feature, part in zip(features, whitened.slices, strict=True):
        along = shared[part].T @ feature
        metrics.append(feature.T @ feature - along.T @ along)
    spread = whitened.scale_spread
    observed_p, smallest, statistics = np.empty(len(regions)), np.ones(size), np.empty(len(regions))
    for at, columns in enumerate(places):
        total, null, freedom = 0.0, np.zeros(size), 0
        for index, part in columns:
            root = _inverse_root(metrics[index][part, part])
            total += float(np.sum((products[index][:, part] @ root) ** 2))
            null += np.sum((drawn[index][:, part] @ root) ** 2, axis=1)
            freedom += root.shape[1]
        statistics[at] = total
        observed_p[at] = float(chi_square_tail(total, max(freedom, 1), spread)) if freedom else 1.0
        if freedom:
            smallest = np.minimum(smallest, chi_square_tail(null, freedom, spread))
    adjusted = family_p_value(observed_p, smallest)
    scores = tuple(
        RegionScore(
            region.kind,
            region.label,
            tuple(records[index].name for index, _ in region.members),
            float(statistics[at]),
            float(adjusted[at]),
            _rms([records[index].residual[inside] for index, inside in region.members]),
        )
        for at, region in enumerate(regions)
    )
    by_record = {
        record.name: min(
            (float(p) for region, p in zip(regions, adjusted, strict=True) if _is_own(region, index)), default=1.0
        )
        for index, record in enumerate(records)
    }
    return Where(_located(whitened, regions, adjusted, level), scores, by_record)


def contribution_regions(
    records: Sequence[RecordResidual],
    contribution: Sequence[FloatArray],
    gradient: Sequence[FloatArray],
    covariance: FloatArray,
    p_value: float,
) -> tuple[Located, ...]:
    """Where an effect shows: what a refit cannot smear.

    In each record the shortest segment that holds nine tenths of the effect's energy, as far as its own contribution
    is certain; records that hold next to nothing of it are left out.

    Parameters
    ----------
    records : sequence of RecordResidual
    contribution : sequence of ndarray, shape (n_r,) [MPa]
        Model with the effect minus model without it, at the same base parameters.
    gradient : sequence of ndarray, shape (n_r, m)
        Its derivatives along the effect's parameters.
    covariance : ndarray, shape (m, m)
        Of these parameters.
    p_value : float
        Of the effect; reported with every region.
    """
    energy = [values**2 for values in contribution]
    masks = []
    for values, slopes in zip(contribution, gradient, strict=True):
        error = np.sqrt(np.maximum(np.einsum("ij,jk,ik->i", slopes, covariance, slopes), 0.0))
        masks.append(np.abs(values) > DETECTION.outline_errors * error)
    sure = [np.where(mask, own, 0.0) for mask, own in zip(masks, energy, strict=True)]
    total = float(sum(own.sum() for own in sure))
    masks = [_shortest_part(own, DETECTION.negligible_energy * total) for own in sure]
    return _report(records, masks, energy, float(sum(e.sum() for e in energy)), [p_value] * len(records))


def _features(whitened: Whitened, regions: list[Region]) -> tuple[list[FloatArray], list[list[tuple[int, slice]]]]:
    """Whitened parabolas over every region, per record; and which columns belong to which region."""
    blocks: list[list[FloatArray]] = [[] for _ in whitened.records]
    width = [0] * len(whitened.records)
    places: list[list[tuple[int, slice]]] = []
    for region in regions:
        where = []
        for index, inside in region.members:
            members = np.flatnonzero(inside)
            degree = DETECTION.region_degree if len(members) >= DETECTION.parabola_samples else 0
            columns = np.zeros((len(inside), degree + 1))
            columns[members] = np.polynomial.legendre.legvander(np.linspace(-1.0, 1.0, len(members)), degree)
            blocks[index].append(columns)
            where.append((index, slice(width[index], width[index] + degree + 1)))
            width[index] += degree + 1
        places.append(where)
    white = []
    for noise, own in zip(whitened.noises, blocks, strict=True):
        columns = noise.whiten(np.hstack(own))
        white.append(columns / np.linalg.norm(columns, axis=0))
    return white, places


def _inverse_root(metric: FloatArray) -> FloatArray:
    """R with R R^T = metric^-1 over the directions that the refit leaves; columns may be fewer."""
    values, vectors = np.linalg.eigh(metric)
    seen = values > 1e-6
    return np.asarray(vectors[:, seen] / np.sqrt(values[seen]), dtype=np.float64)


def _is_own(region: Region, index: int) -> bool:
    return region.kind in ("time", "record") and region.members[0][0] == index


def _rms(parts: list[FloatArray]) -> float:
    return float(np.sqrt(np.mean(np.concatenate(parts) ** 2)))


def _outline(values: FloatArray, error: FloatArray) -> NDArray[np.bool_]:
    size = np.abs(values)
    inside: NDArray[np.bool_] = (size > DETECTION.outline_errors * error) & (
        size > DETECTION.outline_fraction * float(size.max(initial=0.0))
    )
    return inside


def _shortest_part(energy: FloatArray, least: float) -> NDArray[np.bool_]:
    """Samples of the shortest part of a record with `DETECTION.acting_energy` of its energy.

    None where that is `least` or less.
    """
    inside = np.zeros(len(energy), dtype=bool)
    passed = np.concatenate([[0.0], np.cumsum(energy)])
    if passed[-1] > least:
        stop = np.searchsorted(passed, passed[:-1] + DETECTION.acting_energy * passed[-1] * (1.0 - 1e-12))
        length = np.where(stop < len(passed), stop - np.arange(len(energy)), len(passed))
        first = int(np.argmin(length))
        inside[first : stop[first]] = True
    return inside


def _located(whitened: Whitened, regions: list[Region], adjusted: FloatArray, level: float) -> tuple[Located, ...]:
    records = whitened.records
    energy, masks, values = [], [], []
    for index, record in enumerate(records):
        curve, error = _smooth_curve(whitened, index)
        energy.append(np.maximum(curve**2 - error**2, 0.0))
        sure = [
            (region.members[0][1], float(p))
            for region, p in zip(regions, adjusted, strict=True)
            if _is_own(region, index) and p < level
        ]
        allowed = np.zeros(len(record), dtype=bool)
        for inside, _ in sure:
            allowed |= inside
        masks.append(_outline(curve, error) & allowed)
        values.append(min((p for _, p in sure), default=1.0))

    return _report(records, masks, energy, float(sum(e.sum() for e in energy)), values)


def _smooth_curve(whitened: Whitened, index: int) -> tuple[FloatArray, FloatArray]:
    """The smooth part of a record's residual by generalised least squares, and its standard error [MPa]."""
    record, noise = whitened.records[index], whitened.noises[index]
    basis = smooth_basis(record.time, record.jumps, DETECTION.outline_waves).columns
    white = noise.whiten(basis)
    left, upper = np.linalg.qr(white)
    # R^-1 by least squares: columns that hang on others take no part.
    inverse = np.linalg.pinv(upper, rcond=1e-6)
    clean = noise.whiten(whitened.clean(index))
    curve = basis @ (inverse @ (left.T @ clean))
    error = np.linalg.norm(basis @ inverse, axis=1)
    return np.asarray(curve), np.asarray(error)


def _report(
    records: Sequence[RecordResidual],
    masks: list[NDArray[np.bool_]],
    energy: list[FloatArray],
    total: float,
    p_values: list[float],
) -> tuple[Located, ...]:
    located = []
    for record, inside, own, p_value in zip(records, masks, energy, p_values, strict=True):
        count = len(record)
        for part in runs(
            inside,
            bridge=int(DETECTION.bridged_interruption * count),
            least=max(int(DETECTION.shortest_region * count), 1),
        ):
            strain = record.true_strain[part]
            located.append(
                Located(
                    record.name,
                    (float(record.time[part][0]), float(record.time[part][-1])),
                    (float(strain.min()), float(strain.max())),
                    _rms([record.residual[part]]),
                    float(own[part].sum() / total) if total > 0.0 else 0.0,
                    p_value,
                    part,
                )
            )
    return tuple(sorted(located, key=lambda region: -region.share))
