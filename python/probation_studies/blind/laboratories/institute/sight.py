"""What causes add to the records, and how much of it stands out of errors, specimens and the base law's refit."""

from __future__ import annotations

from dataclasses import replace
from itertools import accumulate, pairwise
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from probation_studies.blind.laboratories.institute.modal import (
    Course,
    FloatArray,
    on_grid,
    plain,
    solve,
)

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.institute.causes import Change
    from probation_studies.blind.laboratories.institute.instruments import Instruments
    from probation_studies.blind.laboratories.institute.series import Series, Test

_NUDGE, _LITTLE = 1e-3, 1e-7


def shown(
    test: Test, changes: Sequence[Change], stress: FloatArray, area: float = 0.0
) -> tuple[FloatArray, FloatArray]:
    """True strain and force over the first section [MPa] that the channels carry, at the nodes.

    `stress` is the specimen's, `area` the part by which its section is larger than measured.
    """
    for change in changes:
        if change.stress is not None:
            stress = change.stress(stress)
    strain = test.strain[::2]
    force = (1.0 + area) * stress * np.exp(-strain)
    for change in changes:
        if change.channels is not None:
            strain, force = change.channels(strain, force)
    return strain, force


def course_of(test: Test, changes: Sequence[Change]) -> Course:
    """What the specimen goes through."""
    course = test.course
    for change in changes:
        if change.course is not None:
            course = change.course(course)
    return course


def added(test: Test, variants: Sequence[Change]) -> FloatArray:
    """Recorded stress less the base law's along the recorded strain [MPa], shape (n_samples, n_variants)."""
    changed = [course_of(test, [each]) for each in variants if each.course is not None]
    stresses = iter(solve(test.time, changed)) if changed else iter(())
    with np.errstate(all="ignore"):  # what a form cannot do here ends as not finite
        seen = [shown(test, [each], next(stresses) if each.course is not None else test.stress) for each in variants]
    own = test.strain[::2]
    moved = [not np.array_equal(strain, own) for strain, _ in seen]
    along = [plain(test.polymer, test.time, on_grid(strain)) for (strain, _), by in zip(seen, moved, strict=True) if by]
    with np.errstate(all="ignore"):
        followed = iter(solve(test.time, along)) if along else iter(())
    columns = [
        force * np.exp(strain) - (next(followed) if by else test.stress)
        for (strain, force), by in zip(seen, moved, strict=True)
    ]
    return np.stack(columns, axis=1)[test.path.samples]


def strain_response(test: Test) -> FloatArray:
    """d(recorded stress - law)/d(strain sample) [MPa], shape (n, n): one solution for every sample's hat.

    A companion relation takes its rate from the samples, too: noise that is small beside their steps is in here whole.
    """
    nodes = test.path.samples
    time, strain = (on_grid(values[::2][nodes]) for values in (test.time, test.strain))
    hats = np.eye(len(time[::2]))
    courses = [plain(test.polymer, time, strain + _LITTLE * on_grid(hat)) for hat in (0.0 * hats[0], *hats)]
    base, *moved = solve(time, courses, graded=False)
    return np.asarray(np.diag(test.stress[nodes]) - (np.array(moved) - base).T / _LITTLE)


def _tangents(test: Test) -> FloatArray:
    """By the logarithms of modulus, relaxation time, hardening modulus and section [MPa], shape (n, 4)."""
    slower = replace(test.course, log_time=test.course.log_time + _NUDGE)
    soft = replace(test.course, relaxed=0.0 * test.course.relaxed)
    base, slow, elastic = test.stress, *solve(test.time, [slower, soft])
    return np.stack([elastic, (slow - base) / _NUDGE, base - elastic, base], axis=1)[test.path.samples]


def lost(test: Test) -> FloatArray:
    """Stress that is lost between samples and before the first one [MPa]."""
    samples = test.path.samples
    time = test.time[2 * test.path.first :]
    straight = np.interp(time[::2], test.time[::2][samples], test.strain[::2][samples])
    found = solve(time, [plain(test.polymer, time, on_grid(straight))])[0]
    return np.asarray(test.stress[samples] - found[:: samples.step])


class Sight:
    """The space of a series' identified records in which causes are seen: errors of variance 1, no base law.

    Parameters
    ----------
    series : Series

    Attributes
    ----------
    tests : tuple of Test
        Those that are identified.
    responses, deviating : list of ndarray
        To the strain samples (n, n) and to a specimen's deviations (n, 4), by record [MPa].
    """

    def __init__(self, series: Series) -> None:
        self.tests = tuple(test for test in series.tests if not test.held_out)
        self.responses = [strain_response(test) for test in self.tests]
        self.deviating = [_tangents(test) for test in self.tests]
        self._factors = [
            self._factor(
                test, series.instruments, response, None if series.scatter is None else each * series.scatter.values
            )
            for test, response, each in zip(self.tests, self.responses, self.deviating, strict=True)
        ]
        ends = list(accumulate((len(factor) for factor in self._factors), initial=0))
        self.rows = [slice(a, b) for a, b in pairwise(ends)]
        tangents = np.vstack([self._white(k, each[:, :3]) for k, each in enumerate(self.deviating)])
        self._followed = np.linalg.qr(tangents)[0]

    @staticmethod
    def _factor(test: Test, instruments: Instruments, response: FloatArray, scattered: FloatArray | None) -> FloatArray:
        samples = test.path.samples
        time, strain = test.time[::2][samples], test.strain[::2][samples]
        covariance = instruments.stress_covariance(time, strain)
        covariance += response @ instruments.strain_covariance(time) @ response.T
        if scattered is not None:
            covariance += scattered @ scattered.T
        return np.asarray(cholesky(covariance, lower=True, check_finite=False))

    def _white(self, record: int, columns: FloatArray) -> FloatArray:
        return np.asarray(solve_triangular(self._factors[record], columns, lower=True, check_finite=False))

    def whitened(self, by_record: Sequence[FloatArray]) -> FloatArray:
        """Columns of every record [MPa], (n, n_columns) each, whitened and put below each other."""
        return np.concatenate([self._white(k, each) for k, each in enumerate(by_record)])

    def left(self, whitened: FloatArray) -> FloatArray:
        """Without what the base law's parameters follow."""
        return np.asarray(whitened - self._followed @ (self._followed.T @ whitened))

    def placed(self, whitened: FloatArray, record: int | None) -> FloatArray:
        """Columns that act in one record alone (None: in all), orthogonal to the base law."""
        if record is None:
            return self.left(whitened)
        alone = np.zeros_like(whitened)
        alone[self.rows[record]] = whitened[self.rows[record]]
        return self.left(alone)
