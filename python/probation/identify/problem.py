"""The identification problem: fit residuals of a law on several records, and their sensitivities."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation.errors import InputError
from probation.identify.noise_model import NoiseModel
from probation.law.modal import Law
from probation.law.schemes import Scheme, SchemeName, as_scheme, at_samples, make_solver
from probation.records.checks import require_signal
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Iterable, Iterator, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

LEAST_NOISE = 1e-6
"""Least noise of a record, as a fraction of its stress range: a synthetic record has much weight, not all of it."""


@dataclass(frozen=True, eq=False)
class RecordProblem:
    """One record, ready to be solved for again and again.

    Attributes
    ----------
    record : Record
    excitation : Excitation
    solver : Solver
    noise : float
        Standard deviation of the stress noise [MPa]: given with the record, else by robust differences.
    scheme : Scheme
    substeps : int
        Steps of the scheme from sample to sample.
    """

    record: Record
    excitation: Excitation
    solver: _core.Solver
    noise: float
    scheme: Scheme
    substeps: int

    @classmethod
    def prepare(
        cls, record: Record, excitation: Excitation, scheme: Scheme | SchemeName, substeps: int = 1
    ) -> RecordProblem:
        """Estimate the noise and set up the solver.

        Raises
        ------
        InputError
            For a record whose strain does not move or that bears no stress.
        """
        require_signal(record)
        noise = record.noise.stress_MPa
        if noise is None:
            noise = scatter(record.time, record.true_stress)
        noise = max(noise, LEAST_NOISE * float(np.ptp(record.true_stress)), 1e-12)
        solver = make_solver(excitation.refined(substeps).strain_history().engine, scheme)
        return cls(record, excitation, solver, noise, at_samples(scheme), substeps)

    def with_substeps(self, substeps: int) -> RecordProblem:
        """The same with other steps of the scheme."""
        solver = make_solver(self.excitation.refined(substeps).strain_history().engine, self.scheme)
        return replace(self, solver=solver, substeps=substeps)

    def reference(self) -> RecordProblem:
        """The same by SA3 on the same steps, whose own error is far smaller."""
        return replace(self, solver=make_solver(self.solver.history, "sa3"), scheme=as_scheme("sa3"))

    def driven_by(self, excitation: Excitation) -> RecordProblem:
        """The same record, the law driven otherwise."""
        solver = make_solver(excitation.refined(self.substeps).strain_history().engine, self.scheme)
        return replace(self, excitation=excitation, solver=solver)

    def stress(self, law: Law) -> FloatArray:
        """Model stress, shape (n_times,) [MPa]."""
        stress = np.empty(len(self.solver.history))
        with self._named():
            self.solver.stress(law.engine, _core.LawChange(), stress)
        return stress[:: self.substeps]

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Let what the engine refuses name the record: a companion relation that has no time at its rates."""
        try:
            yield
        except InputError as error:
            raise InputError(f"record {self.record.id!r}: {error}") from None

    def sensitivity(self, law: Law) -> tuple[FloatArray, FloatArray]:
        """Model stress (n_times,) [MPa] and its derivatives (n_times, 3) along `law.parameters`."""
        count = len(self.solver.history)
        stress, sensitivity = np.empty(count), np.empty((count, 3))
        change = _core.LawChange()
        directions = _core.parameter_directions(law.engine, change, self.solver.history)
        with self._named():
            self.solver.tangent(law.engine, change, directions, stress, sensitivity)
        return stress[:: self.substeps], sensitivity[:: self.substeps]


class Problem:
    """Fit residuals (model - data) of all records, each whitened by its noise model, stacked.

    Parameters
    ----------
    law : Law
        The base law; its parameters are where a search may start.
    records : sequence of RecordProblem
    held : tuple of bool, shape (3,)
        Which of `law.parameters` are not identified.

    Attributes
    ----------
    noises : list of NoiseModel
        Per record; what the residuals are whitened with.
    white : tuple of NoiseModel
        What `noises` were while the noise was taken as white.
    """

    def __init__(self, law: Law, records: Sequence[RecordProblem], held: tuple[bool, bool, bool]) -> None:
        self.law = law
        self.records = tuple(records)
        self.held = np.array(held)
        self.noises = [NoiseModel.white(each.noise, each.record.time) for each in self.records]
        self.white = tuple(self.noises)

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the identified parameters."""
        return np.flatnonzero(~self.held)

    @property
    def lengths(self) -> list[int]:
        """Samples of each record."""
        return [len(each.record) for each in self.records]

    def law_at(self, free_values: FloatArray) -> Law:
        """The law with other values of the identified parameters."""
        values = self.law.parameters
        values[self.free] = free_values
        return self.law.with_parameters(values)

    def whitened(self, parts: Iterable[FloatArray]) -> FloatArray:
        """One array per record, whitened and stacked."""
        return np.concatenate([noise.whiten(part) for noise, part in zip(self.noises, parts, strict=True)])

    def data(self) -> FloatArray:
        """Whitened measured stress, shape (n_samples,) [-]."""
        return self.whitened(each.record.true_stress for each in self.records)

    def residual(self, law: Law) -> FloatArray:
        """Whitened fit residual, shape (n_samples,) [-]."""
        return self.whitened(each.stress(law) - each.record.true_stress for each in self.records)

    def residual_and_jacobian(self, law: Law) -> tuple[FloatArray, FloatArray]:
        """Whitened fit residual (n_samples,) and its derivatives (n_samples, 3) along `law.parameters`."""
        residuals, jacobians = [], []
        for each in self.records:
            stress, sensitivity = each.sensitivity(law)
            residuals.append(stress - each.record.true_stress)
            jacobians.append(sensitivity)
        return self.whitened(residuals), self.whitened(jacobians)

    def reweigh(self, law: Law) -> None:
        """Weigh each record by what really scatters it around the law: noise and bias together."""
        for index, each in enumerate(self.records):
            residual = each.stress(law) - each.record.true_stress
            scale = max(each.noise, float(np.sqrt(np.mean(residual**2))))
            self.noises[index] = NoiseModel.white(scale, each.record.time)
        self.white = tuple(self.noises)
