"""The identification problem: a law, its records, their noise, and which parameters are sought. Nothing moves in it."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.record_noise import RecordNoise
from probation.noise.arma import Arma
from probation.noise.model import NoiseModel
from probation.noise.outliers import without_outliers

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.inference.record_problem import RecordProblem
    from probation.law.modal import Law


@dataclass(frozen=True, eq=False)
class Problem:
    """Fit residuals (model - data) of all records, each whitened by its noise, stacked.

    It is never changed: what differs is another problem, from `with_records`, `with_noises` and the like. Every
    method is a function of the problem and the law that it is given.

    Attributes
    ----------
    law : Law
        Its parameters are where a search may start, and the values of those that are held.
    records : tuple of RecordProblem
    held : tuple of bool, shape (3,)
        Which of `law.parameters` are not identified.
    noises : tuple of RecordNoise
        Per record; what the residuals are whitened with.
    """

    law: Law
    records: tuple[RecordProblem, ...]
    held: tuple[bool, ...]
    noises: tuple[RecordNoise, ...]

    @classmethod
    def of(cls, law: Law, records: Iterable[RecordProblem], held: Sequence[bool]) -> Problem:
        """With white noise of every record's own size."""
        records = tuple(records)
        noises = tuple(_white(each, each.noise) for each in records)
        return cls(law, records, tuple(held), noises)

    def with_records(self, records: Iterable[RecordProblem]) -> Problem:
        """The same records solved otherwise: by another scheme, in other steps, driven by another strain."""
        return replace(self, records=tuple(records))

    def with_noises(self, noises: Iterable[RecordNoise]) -> Problem:
        """The same with other noise, one for each record."""
        return replace(self, noises=tuple(noises))

    def with_held(self, index: int, law: Law) -> Problem:
        """The same with one more parameter held, at its value in `law`."""
        held = tuple(was or at == index for at, was in enumerate(self.held))
        return replace(self, law=law, held=held)

    def frozen_at(self, law: Law) -> Problem:
        """The same with the noise as it is at one law."""
        return self.with_noises(noise.frozen_at(law) for noise in self.noises)

    def reweighed(self, law: Law) -> Problem:
        """The same, each record weighed by what really scatters it around the law: noise and bias together."""
        noises = []
        for each in self.records:
            scale = max(each.noise, float(np.sqrt(np.mean(each.residual(law) ** 2))))
            noises.append(_white(each, scale))
        return self.with_noises(noises)

    @property
    def free(self) -> NDArray[np.intp]:
        """Indices of the identified parameters."""
        return np.flatnonzero(~np.array(self.held))

    @property
    def lengths(self) -> list[int]:
        """Samples of each record."""
        return [len(each.record) for each in self.records]

    @property
    def carries_strain_noise(self) -> bool:
        """Whether the residual of any record is weighed for the noise of its strain."""
        return any(noise.carries_strain_noise for noise in self.noises)

    @property
    def noise_moves(self) -> bool:
        """Whether the noise of any record depends on the law."""
        return any(noise.strain is not None for noise in self.noises)

    def law_at(self, free_values: FloatArray) -> Law:
        """The law with other values of the identified parameters."""
        values = self.law.parameters
        values[self.free] = free_values
        return self.law.with_parameters(values)

    def noises_at(self, law: Law) -> tuple[NoiseModel, ...]:
        """Every record's noise at a law."""
        return tuple(noise.at(law) for noise in self.noises)

    def whitened(self, parts: Iterable[FloatArray], law: Law) -> FloatArray:
        """One array per record, its outliers set aside, whitened by the noise at a law, and stacked."""
        return np.concatenate(
            [
                noise.whiten(without_outliers(part, noise.outliers))
                for noise, part in zip(self.noises_at(law), parts, strict=True)
            ]
        )

    def data(self, law: Law) -> FloatArray:
        """Measured stress, whitened by the noise at a law, shape (n_samples,) [-]."""
        return self.whitened((each.record.true_stress for each in self.records), law)

    def residual(self, law: Law) -> FloatArray:
        """Whitened fit residual, shape (n_samples,) [-]."""
        return self.whitened((each.residual(law) for each in self.records), law)

    def residual_and_jacobian(self, law: Law) -> tuple[FloatArray, FloatArray]:
        """Whitened fit residual (n_samples,), and the sensitivities (n_samples, 3) that make its exact gradient.

        Where strain noise moves with the law, J - (d C / d theta) delta stands in for J, delta the strain errors that
        reconcile record and law: Gauss-Newton then descends along the gradient of r^T Sigma(theta)^-1 r.
        """
        residuals, jacobians = [], []
        for each, noise in zip(self.records, self.noises, strict=True):
            stress, sensitivity = each.sensitivity(law)
            residual = stress - each.record.true_stress
            if noise.strain is not None:
                errors = noise.at(law).strain_errors(residual)
                sensitivity = sensitivity.copy()
                sensitivity[:, self.free] -= noise.strain.slopes(law, errors, self.free.tolist())
            residuals.append(residual)
            jacobians.append(sensitivity)
        return self.whitened(residuals, law), self.whitened(jacobians, law)


def _white(each: RecordProblem, level: float) -> RecordNoise:
    """White stress noise of one size along a record."""
    return RecordNoise(NoiseModel.stationary(each.record.id, Arma(innovation=level), len(each.record)))
