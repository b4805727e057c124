"""One record, ready to be solved for again and again."""

from __future__ import annotations

from contextlib import contextmanager
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation.errors import InputError
from probation.law.schemes import Scheme, SchemeName, as_scheme, at_samples, make_solver
from probation.records.checks import require_signal
from probation.records.noise import scatter

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation._arrays import FloatArray
    from probation.law.modal import Law
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation

LEAST_NOISE = 1e-6
"""Least noise of a record, as a fraction of its stress range: a synthetic record has much weight, not all of it."""


@dataclass(frozen=True, eq=False)
class RecordProblem:
    """One record and what drives the law along it.

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

    def residual(self, law: Law) -> FloatArray:
        """Fit residual, model - data, shape (n_times,) [MPa]."""
        return np.asarray(self.stress(law) - self.record.true_stress)

    def sensitivity(self, law: Law) -> tuple[FloatArray, FloatArray]:
        """Model stress (n_times,) [MPa] and its derivatives (n_times, 3) along `law.parameters`."""
        count = len(self.solver.history)
        stress, sensitivity = np.empty(count), np.empty((count, 3))
        change = _core.LawChange()
        directions = _core.parameter_directions(law.engine, change, self.solver.history)
        with self._named():
            self.solver.tangent(law.engine, change, directions, stress, sensitivity)
        return stress[:: self.substeps], sensitivity[:: self.substeps]

    @contextmanager
    def _named(self) -> Iterator[None]:
        """Let what the engine refuses name the record: a companion relation that has no time at its rates."""
        try:
            yield
        except InputError as error:
            raise InputError(f"record {self.record.id!r}: {error}") from None
