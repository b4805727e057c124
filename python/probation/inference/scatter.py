"""How far specimens differ: what a campaign states, what replicates show, or what is assumed
(docs/diagnosis-method.md, section 10).

Replicates are records of different specimens under one strain history, at one temperature. What the law misses is the
same in all of them and stands in the mean of the group; what differs within a group is noise and the specimens'
deviations. Their variances are had from that alone, by restricted likelihood, so that no missing effect passes for
scatter.

E_u, G and the section cannot be separated in one specimen; over several they can, as far as E_u and G vary together.
"""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from probation.inference.deviations import START, TITLES, deviation_names, kind_of_deviation
from probation.noise.outliers import without_outliers
from probation.records.specimens import DEVIATIONS
from probation.results.data import LEFT_OUT
from probation.settings.noise import NOISE
from probation.wording import listed, percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.inference.protocol import GapLaw
    from probation.noise.model import NoiseModel
    from probation.noise.record_residual import RecordResidual
    from probation.records.record import Record
    from probation.records.specimens import Specimens


FIRST_STEP, ACCEPTED, ADAPTED = 0.7, 0.44, 0.2
"""Metropolis: the first step of a logarithm, the acceptance that steps are adapted to (Roberts & Rosenthal 2001), and
by how much each time."""

Source = Literal["replicates", "assumed", "stated", "none"]


@dataclass(frozen=True)
class Scatter:
    """How far specimens differ.

    Attributes
    ----------
    names : tuple of str
        As `deviation_names`.
    deviations : tuple of float
        Standard deviations [-]; of estimated ones the root mean square of what the replicates leave possible.
    intervals : tuple of (float, float), or None
        95 %; None where nothing was estimated.
    specimens : int
        How many there are among the identify records.
    source : {"replicates", "assumed", "stated", "none"}
    draws : ndarray, shape (n_draws, n_deviations), or None
        Of the deviations' posterior; None where nothing was estimated.
    """

    names: tuple[str, ...]
    deviations: tuple[float, ...]
    intervals: tuple[tuple[float, float], ...] | None
    specimens: int
    source: Source
    draws: FloatArray | None = field(default=None, metadata=LEFT_OUT)

    def to_dict(self) -> dict[str, Any]:
        """As in `scatter` of docs/formats.md; without what specimens are alike in."""
        return {
            name: {
                "relative": size,
                "interval95": None if self.intervals is None else list(self.intervals[index]),
                "specimens": self.specimens,
                "source": self.source,
            }
            for index, (name, size) in enumerate(zip(self.names, self.deviations, strict=True))
            if size > 0.0
        }

    @property
    def text(self) -> str:
        """How far specimens differ, in words: "specimens differ by 1.9 % in E_u and 2.4 % in G"."""
        if not self.any:
            return "specimens are taken as alike"
        if self.source == "assumed":
            return f"without replicates it is assumed that specimens differ by {listed(self._seen, 'and')}"
        if not self.is_seen:
            return "replicates do not show that specimens differ"
        said = "are said to " if self.source == "stated" else ""
        return f"specimens {said}differ by {listed(self._seen, 'and')}"

    @property
    def _seen(self) -> list[str]:
        """What specimens differ in for certain, and by how much, in words."""
        return [
            f"{size:.2g} in {TITLES[name]}" if name == START else f"{percentage(size)} % in {TITLES.get(name, name)}"
            for index, (name, size) in enumerate(zip(self.names, self.deviations, strict=True))
            if size > 0.0 and (self.intervals is None or self.intervals[index][0] > NOISE.scatter_seen * size)
        ]

    @property
    def is_seen(self) -> bool:
        """Whether specimens differ for certain, as replicates show, as is assumed or as is stated."""
        return bool(self._seen)

    @property
    def known(self) -> bool:
        """Whether it is more than an assumption: from replicates, or stated."""
        return self.source in ("replicates", "stated")

    @property
    def any(self) -> bool:
        """Whether specimens may differ at all."""
        return any(size > 0.0 for size in self.deviations)


def scatter_of(
    specimens: Specimens,
    law: GapLaw,
    records: Sequence[RecordResidual],
    noises: Sequence[NoiseModel],
    columns: Sequence[FloatArray],
) -> Scatter:
    """The scatter of a campaign's specimens.

    Parameters
    ----------
    specimens : Specimens
        What the campaign says of it.
    law : GapLaw
    records : sequence of RecordResidual
        The identify records at one fit.
    noises : sequence of NoiseModel
        Without any scatter in them.
    columns : sequence of ndarray, shape (n_r, n_deviations) [MPa]
        `deviation_columns` of each.
    """
    names = deviation_names(law)
    count = len(set(_owners(records)))
    if specimens.alike:
        return Scatter(names, (0.0,) * len(names), None, count, "none")
    if not isinstance(specimens.scatter, str):
        stated = specimens.scatter
        return Scatter(names, tuple(stated.get(kind_of_deviation(name), 0.0) for name in names), None, count, "stated")
    usual = tuple(NOISE.specimen_scatter[DEVIATIONS.index(kind_of_deviation(name))] for name in names)
    groups = replicates(records)
    if not groups:
        return Scatter(names, usual, None, count, "assumed")
    draws = _drawn(groups, records, noises, columns, np.array(usual))
    deviations = np.sqrt(np.mean(draws**2, axis=0))
    ends = np.quantile(draws, (0.025, 0.975), axis=0)
    intervals = tuple((float(low), float(high)) for low, high in ends.T)
    return Scatter(names, tuple(deviations.tolist()), intervals, count, "replicates", draws)


def replicates(records: Sequence[Record | RecordResidual]) -> list[list[int]]:
    """Records of different specimens under one strain history and at one temperature each, by their indices.

    At two temperatures a law that misses their difference would see it as scatter.
    """
    groups: list[list[int]] = []
    for index, record in enumerate(records):
        for group in groups:
            if _alike(records[group[0]], record):
                group.append(index)
                break
        else:
            groups.append([index])
    owners = _owners(records)
    return [group for group in groups if len({owners[index] for index in group}) > 1]


def _alike(first: Record | RecordResidual, other: Record | RecordResidual) -> bool:
    warm = [_start_temperature(record) for record in (first, other)]
    if abs(warm[0] - warm[1]) > NOISE.same_temperature:  # never, where one is not known (NaN)
        return False
    spans = [record.time[-1] - record.time[0] for record in (first, other)]
    if min(spans) < NOISE.least_time_in_common * max(spans):
        return False
    time = first.time - first.time[0]
    time = time[time <= min(spans)]
    own = first.true_strain[: len(time)]
    away = np.interp(time, other.time - other.time[0], other.true_strain) - own
    return bool(np.sqrt(np.mean(away**2)) <= NOISE.same_history * max(float(np.ptp(own)), 1e-300))


def _start_temperature(record: Record | RecordResidual) -> float:
    return float("nan") if record.temperature is None else float(np.ravel(record.temperature)[0])


def _owners(records: Sequence[Record | RecordResidual]) -> list[int | str]:
    """The specimen of each record: as the campaign names it, or the record's own."""
    return [index if record.specimen_id is None else record.specimen_id for index, record in enumerate(records)]


def _drawn(
    groups: Sequence[Sequence[int]],
    records: Sequence[RecordResidual],
    noises: Sequence[NoiseModel],
    columns: Sequence[FloatArray],
    usual: FloatArray,
) -> FloatArray:
    """Draws of the standard deviations, given the replicates, shape (n_draws, n_deviations)."""
    values, designs, means, owners = [], [], [], []
    for number, group in enumerate(groups):
        shortest = min(float(np.ptp(records[index].time)) for index in group)
        for index in group:
            record, noise = records[index], noises[index].alike
            common = record.time - record.time[0] <= shortest * (1.0 + 1e-9)
            white = noise.whiten(
                np.column_stack([columns[index] * usual, without_outliers(record.residual, noise.outliers)])
            )[common]
            left, size, right = np.linalg.svd(white[:, :-1], full_matrices=False)
            seen = size > 1e-6 * size[0]
            values.append(left[:, seen].T @ white[:, -1])
            designs.append(size[seen, None] * right[seen])
            means += [number] * int(seen.sum())
            owners += [_owners(records)[index]] * int(seen.sum())
    design = np.vstack(designs)
    width = design.shape[1]
    fixed = np.zeros((len(design), width * len(groups)))
    for row, number in enumerate(means):
        fixed[row, number * width : (number + 1) * width] = design[row]
    left, size, _ = np.linalg.svd(fixed)
    contrasts = left[:, int(np.count_nonzero(size > 1e-9 * size[0])) :]
    together = np.array([[one == other for other in owners] for one in owners], dtype=np.float64)
    parts = np.array([contrasts.T @ (np.outer(column, column) * together) @ contrasts for column in design.T])
    seen = contrasts.T @ np.concatenate(values)
    return usual * _walked(parts, seen)


def _walked(parts: FloatArray, seen: FloatArray) -> FloatArray:
    """Draws of s, shape (n_draws, k), given seen ~ N(0, I + sum s_k^2 parts_k) and a prior of root mean square 1.

    The prior is half-Student and ends at `NOISE.largest_scatter`, which takes its root mean square to 0.87.
    """
    count = len(parts)
    scale = np.sqrt((NOISE.scatter_prior_freedom - 2.0) / NOISE.scatter_prior_freedom)

    def log_density(logs: FloatArray) -> float:
        if float(np.max(logs)) > np.log(NOISE.largest_scatter):
            return -np.inf
        squares = np.exp(2.0 * logs)
        covariance = np.eye(len(seen)) + np.tensordot(squares, parts, axes=1)
        try:
            lower = np.linalg.cholesky(covariance)
        except np.linalg.LinAlgError:
            return -np.inf
        left = np.linalg.solve(lower, seen)
        prior = (
            -0.5 * (NOISE.scatter_prior_freedom + 1.0) * np.log1p(squares / scale**2 / NOISE.scatter_prior_freedom)
            + logs
        )
        return float(-np.sum(np.log(np.diag(lower))) - 0.5 * left @ left + np.sum(prior))

    rng = np.random.default_rng(0)
    at = np.zeros(count)
    here = log_density(at)
    drawn = np.empty((NOISE.scatter_draws, count))
    reach = np.full(count, FIRST_STEP)
    for step in range(NOISE.scatter_draws):
        which = step % count
        tried = at.copy()
        tried[which] += reach[which] * rng.standard_normal()
        there = log_density(tried)
        taken = np.log(rng.random()) < there - here
        if taken:
            at, here = tried, there
        if step < NOISE.scatter_burn_in:
            reach[which] *= np.exp(((1.0 - ACCEPTED) if taken else -ACCEPTED) * ADAPTED)
        drawn[step] = at
    return np.exp(drawn[NOISE.scatter_burn_in :])


def with_scatter(
    records: Sequence[RecordResidual], columns: Sequence[FloatArray], scatter: Scatter
) -> list[RecordResidual]:
    """The records with what their specimens' deviations do to them."""
    size = np.array(scatter.deviations)
    kept = size > 0.0
    return [replace(record, specimen=own[:, kept] * size[kept]) for record, own in zip(records, columns, strict=True)]
