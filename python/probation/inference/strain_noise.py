"""Noise of the measured strain, propagated by smoother, differentiator and law to the stress."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation.law.schemes import make_solver

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.law.modal import Law
    from probation.law.schemes import Scheme, SchemeName
    from probation.smoothing.excitation import Excitation

_SPARE, _PER_FREEDOM = 30, 6.0
"""Directions kept of a smoother: its singular values fall as the fourth power beyond its degrees of freedom."""

_STEP = 1e-3
"""Relative change of a parameter over which the propagated noise is differenced."""


@dataclass(frozen=True, eq=False)
class StrainNoise:
    r"""Strain noise of one record as stress: the factor A of its covariance :math:`A A^T`.

    :math:`A = \sigma_\varepsilon J_\varepsilon`, J_eps the derivative of the stress by the measured strain. The law is
    taken on the samples: in the record's own scheme where that takes no substeps, else in the one that is exact between
    samples, SA3 for strains with rates and SA2 for the straight lines between bare samples.

    Attributes
    ----------
    solver : Solver
    deviation : float
        Standard deviation sigma_eps of the strain noise [-].
    strain, rate : ndarray, shape (n_times, n_directions) [-], [1/s], or None
        Independent unit errors as they arrive at the law, behind the smoother. None: every strain sample is one.
    """

    solver: _core.Solver
    deviation: float
    strain: FloatArray | None
    rate: FloatArray | None
    _made: dict[bytes, FloatArray] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, excitation: Excitation, scheme: Scheme | SchemeName, substeps: int = 1) -> StrainNoise:
        """That of a record, driven by an excitation at its samples."""
        solver = solver_on_samples(excitation, scheme, substeps)
        return cls(solver, _deviation(excitation), *(_directions(excitation) or (None, None)))

    def propagated(self, law: Law) -> FloatArray:
        """A: the stress made by each error of one standard deviation, shape (n_times, n_directions) [MPa]."""
        key = law.parameters.tobytes()
        if key not in self._made:
            while len(self._made) > 1:  # two: a search compares a law with the one that it came from
                del self._made[next(iter(self._made))]
            self._made[key] = (
                self.solver.strain_sensitivity(law.engine, _core.LawChange())
                if self.strain is None
                else tangents_along(self.solver, law, self.strain, self.rate)
            )
        return self.deviation * self._made[key]

    def along(self, law: Law, errors: FloatArray) -> FloatArray:
        """Stress made by those errors, in units of their standard deviation; shape (n_times,) [MPa]."""
        strain = errors if self.strain is None else self.strain @ errors
        rate = None if self.rate is None else (self.rate @ errors)[:, None]
        return self.deviation * tangents_along(self.solver, law, strain[:, None], rate)[:, 0]

    def probed(self, law: Law, count: int) -> FloatArray:
        """Stress made by `count` draws of the noise, always the same ones; shape (n_times, count) [MPa]."""
        size = len(self.solver.history) if self.strain is None else self.strain.shape[1]
        errors = np.random.default_rng(0).standard_normal((size, count))
        strain = errors if self.strain is None else self.strain @ errors
        return self.deviation * tangents_along(
            self.solver, law, strain, None if self.rate is None else self.rate @ errors
        )

    def slopes(self, law: Law, errors: FloatArray, wanted: Sequence[int]) -> FloatArray:
        """Derivatives of `along` by the law's parameters number `wanted`; shape (n_times, wanted)."""
        columns = []
        for index in wanted:
            value = law.parameters[index]
            step = _STEP * (abs(value) or 1.0)
            ends = (max(value - step, 0.0), value + step)  # one-sided where the parameter ends, at 0
            sides = []
            for end in ends:
                moved = law.parameters
                moved[index] = end
                sides.append(self.along(law.with_parameters(moved), errors))
            columns.append((sides[1] - sides[0]) / (ends[1] - ends[0]))
        return np.column_stack(columns)


def solver_on_samples(excitation: Excitation, scheme: Scheme | SchemeName, substeps: int = 1) -> _core.Solver:
    """In the record's own scheme where that takes no substeps, else in the one that is exact between samples."""
    if substeps > 1:
        scheme = "sa2" if excitation.strain_rate is None else "sa3"
    return make_solver(excitation.strain_history().engine, scheme)


def tangents_along(solver: _core.Solver, law: Law, strain: FloatArray, rate: FloatArray | None) -> FloatArray:
    """Stress made by errors of the strain and of its rate, columns of shape (n_times, m) [-], [1/s]; in MPa."""
    directions = []
    for at in range(strain.shape[1]):
        direction = _core.Direction()
        direction.true_strain = strain[:, at]
        if rate is not None:
            direction.strain_rate = rate[:, at]
        directions.append(direction)
    stress, tangents = np.empty(len(strain)), np.empty((len(strain), len(directions)))
    solver.tangent(law.engine, _core.LawChange(), directions, stress, tangents)
    return tangents


def leading_directions(excitation: Excitation) -> tuple[FloatArray, FloatArray | None]:
    """Strain and rate by independent errors of one standard deviation, shapes (n_times, n_directions) [-], [1/s].

    Of a smoothed strain what its smoother leaves unknown; of a strain as measured its first sample alone.
    """
    deviation = _deviation(excitation)
    errors = _directions(excitation)
    if errors is None:
        first = np.zeros((len(excitation.time), 1))
        first[0] = deviation
        return first, None if excitation.strain_rate is None else np.zeros_like(first)
    strain, rate = errors
    return deviation * strain, None if rate is None else deviation * rate


def _deviation(excitation: Excitation) -> float:
    """Standard deviation of the strain's noise, that of its slow averages where it is correlated [-]."""
    return float(excitation.strain_noise * np.sqrt(excitation.noise_inflation))


def _directions(excitation: Excitation) -> tuple[FloatArray, FloatArray | None] | None:
    """The few directions in which a smoothed strain errs, by a random range finder (Halko et al. 2011).

    None for a strain as measured.
    """
    make = excitation.errors or excitation.operators
    if make is None:
        return None
    errors = make()
    count, sources = errors.strain.shape
    typical = np.median(np.diff(excitation.time))
    both = np.vstack([errors.strain, typical * errors.rate])
    kept = int(_PER_FREEDOM * float(np.sum(errors.strain**2))) + _SPARE
    if 3 * kept < sources:
        probes = np.random.default_rng(0).standard_normal((sources, kept))
        both = both @ np.linalg.qr(both.T @ (both @ probes))[0]
    return both[:count], None if excitation.strain_rate is None else both[count:] / typical
