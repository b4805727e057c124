"""What causes add to the recorded stress, and what of it stands out of errors, specimens and the base law's refit."""

from __future__ import annotations

from dataclasses import astuple, dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from probation_studies.blind.laboratories.university.errors import strain_response
from probation_studies.blind.laboratories.university.histories import FINER
from probation_studies.blind.laboratories.university.modal_law import base_course, integrate

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation_studies.blind.laboratories.university.causes import Act, Run
    from probation_studies.blind.laboratories.university.design import Design, Test
    from probation_studies.blind.laboratories.university.modal_law import Course, FloatArray

PARAMETERS = ("modulus", "time", "hardening")
_NUDGE = 1e-3


def recorded(run: Run, acts: Sequence[Act], stress: FloatArray, area: float = 0.0) -> tuple[FloatArray, FloatArray]:
    """Recorded true strain and stress [MPa] on the fine grid, of a specimen whose section is `area` larger."""
    for act in acts:
        if act.stress is not None:
            stress = act.stress(stress)
    strain, force = run.strain, (1.0 + area) * stress * np.exp(-run.strain)
    for act in acts:
        if act.recorded is not None:
            strain, force = act.recorded(strain, force)
    return strain, force * np.exp(strain)


def course_of(run: Run, acts: Sequence[Act]) -> Course:
    """What the specimen goes through."""
    course = run.course
    for act in acts:
        if act.course is not None:
            course = act.course(course)
    return course


def added(run: Run, variants: Sequence[Sequence[Act]]) -> FloatArray:
    """Recorded stress less the base law's along the recorded strain [MPa], shape (n_samples, n_variants)."""
    changed = [any(act.course is not None for act in acts) for acts in variants]
    courses = [run.course, *(course_of(run, acts) for acts, by in zip(variants, changed, strict=True) if by)]
    stresses = iter(integrate(run.time, courses))
    base = next(stresses)
    seen = [recorded(run, acts, next(stresses) if by else base) for acts, by in zip(variants, changed, strict=True)]
    moved = [strain is not run.strain for strain, _ in seen]
    followed = [base_course(run.material, run.time, strain) for (strain, _), by in zip(seen, moved, strict=True) if by]
    along = iter(integrate(run.time, followed)) if followed else iter(())
    columns = [stress - (next(along) if by else base) for (_, stress), by in zip(seen, moved, strict=True)]
    return np.stack(columns, axis=1)[::FINER]


@dataclass(frozen=True, eq=False)
class Bench:
    """The identified records of a design, whitened.

    Attributes
    ----------
    design : Design
    tests : tuple of Test
        Those that are identified.
    factors : tuple of ndarray
        Lower Cholesky factors of every record's covariance [MPa]: force, strain through the law, specimen.
    tangents : tuple of ndarray, shape (n, 3)
        Whitened derivatives to the logarithms of the base law's parameters.
    responses : tuple of ndarray, shape (n, n) [MPa]
        To the strain samples.
    specimens : tuple of ndarray, shape (n, 4) [MPa]
        To a specimen's relative deviations: modulus, time, hardening modulus, area.
    """

    design: Design
    tests: tuple[Test, ...]
    factors: tuple[FloatArray, ...]
    tangents: tuple[FloatArray, ...]
    responses: tuple[FloatArray, ...]
    specimens: tuple[FloatArray, ...]

    def whitened(self, record: int, columns: FloatArray) -> FloatArray:
        """Columns of one record in units of its errors."""
        return np.asarray(solve_triangular(self.factors[record], columns, lower=True, check_finite=False))

    @cached_property
    def inverse(self) -> FloatArray:
        """Covariance of the base law's parameters, in parts of them, shape (3, 3)."""
        whole = np.sum([jac.T @ jac for jac in self.tangents], axis=0)
        return np.asarray(np.linalg.inv(whole))

    def products(self, blocks: Sequence[FloatArray]) -> Products:
        """Inner products of whitened columns, with and without what the base law follows.

        `blocks` holds for every record the whitened columns, (n, n_columns).
        """
        inside = np.array([block.T @ block for block in blocks])
        across = np.array([block.T @ jac for block, jac in zip(blocks, self.tangents, strict=True)])
        return Products(inside, across, self.inverse)

    def detectability(self, added_stress: Sequence[FloatArray | None]) -> float:
        """Norm of what is added, whitened and orthogonal to what the base law follows; None where nothing is."""
        norm, across = 0.0, np.zeros(len(PARAMETERS))
        for k, column in enumerate(added_stress):
            if column is not None:
                white = self.whitened(k, column)
                norm += float(white @ white)
                across = across + self.tangents[k].T @ white
        return float(np.sqrt(max(norm - float(across @ self.inverse @ across), 0.0)))


@dataclass(frozen=True, eq=False)
class Products:
    """Inner products of columns by record.

    Attributes
    ----------
    inside : ndarray, shape (n_records, n_columns, n_columns)
    across : ndarray, shape (n_records, n_columns, 3)
        With the base law's tangents.
    inverse : ndarray, shape (3, 3)
        Of the tangents' own products over all records.
    """

    inside: FloatArray
    across: FloatArray
    inverse: FloatArray

    def gram(self, placed: Sequence[tuple[int, int | None]]) -> FloatArray:
        """Of columns that each act in one record, or in all (None), orthogonal to what the base law follows."""
        records = len(self.inside)
        acts = np.array([[place is None or place == k for k in range(records)] for _, place in placed], dtype=float)
        which = [column for column, _ in placed]
        own = np.einsum("ir,jr,rij->ij", acts, acts, self.inside[:, which][:, :, which], optimize=True)
        follows = np.einsum("ir,rip->ip", acts, self.across[:, which])
        return np.asarray(own - follows @ self.inverse @ follows.T)


def bench_of(design: Design) -> Bench:
    """Covariances and tangents of the identified records."""
    tests = tuple(test for test in design.tests if not test.held_out)
    factors, tangents, responses, specimens = [], [], [], []
    for test in tests:
        run = test.run
        response = strain_response(run.material, run.time[::FINER], run.strain[::FINER])
        covariance = design.errors.covariance(response)
        deviating = specimen_response(test)
        if design.scatter is not None:
            scattered = deviating * np.array(astuple(design.scatter))
            covariance = covariance + scattered @ scattered.T
        factor = cholesky(covariance, lower=True, check_finite=False)
        factors.append(factor)
        tangents.append(solve_triangular(factor, deviating[:, :3], lower=True, check_finite=False))
        responses.append(response)
        specimens.append(deviating)
    return Bench(design, tests, tuple(factors), tuple(tangents), tuple(responses), tuple(specimens))


def specimen_response(test: Test) -> FloatArray:
    """To a specimen's relative deviations, modulus, time, hardening modulus and area; shape (n, 4) [MPa]."""
    run = test.run
    nudged = [replace(run.material, **{name: getattr(run.material, name) * (1.0 + _NUDGE)}) for name in PARAMETERS]
    stress = integrate(run.time, [base_course(each, run.time, run.strain) for each in (run.material, *nudged)])
    stress = stress[:, ::FINER]
    return np.column_stack([(stress[1:] - stress[0]).T / _NUDGE, stress[0]])


def sampling_error(bench: Bench) -> float:
    """Detectability of what is lost between the samples: the law along straight lines, against the real path."""
    lost = []
    for test in bench.tests:
        run = test.run
        times, strains = run.time[::FINER], run.strain[::FINER]
        straight = base_course(run.material, run.time, np.interp(run.time, times, strains))
        stress = integrate(run.time, [run.course, straight])[:, ::FINER]
        lost.append(stress[0] - stress[1])
    return bench.detectability(lost)
