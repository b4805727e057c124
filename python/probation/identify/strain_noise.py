"""Noise of the measured strain, carried by smoother, differentiator and law to the stress."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np

from probation import _core
from probation.inference.parameter import SYMBOLS
from probation.law.modal import make_solver
from probation.smoothing.excitation import excite
from probation.smoothing.segments import CLEAN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.identify.problem import RecordProblem
    from probation.law.modal import Law
    from probation.smoothing.excitation import Excitation
    from probation.smoothing.methods import Method as ExcitationMethod

LARGEST = 3000
"""Samples of a record up to which its strain noise has a matrix (that of 3000 takes about 3 s to make and factor)."""

DRAWS = 24
"""Of longer records, the strain is drawn again so often to see what its noise does to the parameters."""

CARRIED_NOISE = 0.3
"""Part of a parameter's error that comes from strain noise, over the rest of it, from which on it matters."""

_SPARE, _PER_FREEDOM = 30, 6.0
"""Directions kept of a smoother: its singular values fall as the fourth power beyond its degrees of freedom."""

_STEP = 1e-3
"""Relative change of a parameter over which the carried noise is differenced."""


@dataclass(frozen=True, eq=False)
class StrainNoise:
    r"""Strain noise of one record as stress, :math:`\sigma_x D` with D = d stress / d measured strain.

    The law is taken on the samples: in the record's own scheme where that takes no substeps, else in the one that is
    exact between samples, SA3 for strains with rates and SA2 for the straight lines between bare samples.

    Attributes
    ----------
    solver : Solver
    deviation : float
        Standard deviation sigma_x of the strain noise [-].
    strain, rate : ndarray, shape (n_times, n_directions) [-], [1/s], or None
        Independent unit errors as they arrive at the law, behind the smoother. None: every strain sample is one.
    """

    solver: _core.Solver
    deviation: float
    strain: FloatArray | None
    rate: FloatArray | None
    _made: dict[bytes, FloatArray] = field(default_factory=dict, repr=False)

    @classmethod
    def of(cls, problem: RecordProblem) -> StrainNoise | None:
        """That of a record; None where its strain has none."""
        excitation = problem.excitation
        if excitation.strain_noise < CLEAN:
            return None
        operator, rate = excitation.strain_operator(), excitation.rate_operator()
        scheme = problem.scheme
        if problem.substeps > 1:
            scheme = "sa2" if excitation.strain_rate is None else "sa3"
        solver = make_solver(excitation.history(), scheme, problem.start)
        if operator is None:
            return cls(solver, excitation.strain_noise, None, None)
        return cls(solver, excitation.strain_noise, *_directions(excitation, operator, rate))

    def carried(self, law: Law) -> FloatArray:
        """Stress made by each unit error, shape (n_times, n_directions) [MPa]."""
        key = law.parameters.tobytes()
        if key not in self._made:
            while len(self._made) > 1:  # two: a search compares a law with the one that it came from
                del self._made[next(iter(self._made))]
            self._made[key] = (
                self.solver.strain_sensitivity(law.engine, _core.LawChange())
                if self.strain is None
                else self._tangents(law, self.strain, self.rate)
            )
        return self.deviation * self._made[key]

    def along(self, law: Law, errors: FloatArray) -> FloatArray:
        """Stress made by those errors, in units of their standard deviation; shape (n_times,) [MPa]."""
        strain = errors if self.strain is None else self.strain @ errors
        rate = None if self.rate is None else (self.rate @ errors)[:, None]
        return self.deviation * self._tangents(law, strain[:, None], rate)[:, 0]

    def probed(self, law: Law, count: int) -> FloatArray:
        """Stress made by `count` draws of the noise, always the same ones; shape (n_times, count) [MPa]."""
        size = len(self.solver.history) if self.strain is None else self.strain.shape[1]
        errors = np.random.default_rng(0).standard_normal((size, count))
        strain = errors if self.strain is None else self.strain @ errors
        return self.deviation * self._tangents(law, strain, None if self.rate is None else self.rate @ errors)

    def slopes(self, law: Law, errors: FloatArray, wanted: Sequence[int]) -> FloatArray:
        """Derivatives of `along` by the law's parameters number `wanted`; shape (n_times, wanted)."""
        columns = []
        for index in wanted:
            sides = []
            value = law.parameters[index]
            step = _STEP * (abs(value) or 1.0)
            for sign in (1.0, -1.0):
                moved = law.parameters
                moved[index] = value + sign * step
                sides.append(self.along(law.with_parameters(moved), errors))
            columns.append((sides[0] - sides[1]) / (2.0 * step))
        return np.column_stack(columns)

    def _tangents(self, law: Law, strain: FloatArray, rate: FloatArray | None) -> FloatArray:
        directions = []
        for at in range(strain.shape[1]):
            direction = _core.Direction()
            direction.true_strain = strain[:, at]
            if rate is not None:
                direction.strain_rate = rate[:, at]
            directions.append(direction)
        stress, tangents = np.empty(len(strain)), np.empty((len(strain), len(directions)))
        self.solver.tangent(law.engine, _core.LawChange(), directions, stress, tangents)
        return tangents


def _directions(
    excitation: Excitation, strain: FloatArray, rate: FloatArray | None
) -> tuple[FloatArray, FloatArray | None]:
    """The few directions in which a smoother lets noise through, by a random range finder (Halko et al. 2011)."""
    count = len(strain)
    typical = np.median(np.diff(excitation.time))
    both = strain if rate is None else np.vstack([strain, typical * rate])
    kept = int(_PER_FREEDOM * float(np.trace(strain))) + _SPARE
    if 3 * kept < count:
        probes = np.random.default_rng(0).standard_normal((count, kept))
        basis = np.linalg.qr(both.T @ (both @ probes))[0]
        both = both @ basis
    else:
        both = both.copy()
    if rate is None:
        return both, None
    return both[:count], both[count:] / typical


def share_of_error(law: Law, noise: StrainNoise, gain: FloatArray, error: FloatArray) -> FloatArray:
    """Error of each parameter by strain noise, over what is known of it without; shape (free,) [-].

    Parameters
    ----------
    gain : ndarray, shape (free, n_times)
        Change of the parameters per stress [1/MPa].
    error : ndarray, shape (free,)
        Standard errors without strain noise.
    """
    if noise.strain is None:  # as many directions as samples: a few draws tell whether they are worth it
        carried = noise.probed(law, 8)
        moved = np.sqrt(np.mean((gain @ carried) ** 2, axis=1))
    else:
        moved = np.linalg.norm(gain @ noise.carried(law), axis=1)
    share: FloatArray = np.divide(moved, error, out=np.full_like(moved, np.inf), where=error > 0.0)
    return share


def resampled(problem: RecordProblem, law: Law, gain: FloatArray, method: ExcitationMethod) -> FloatArray:
    """Covariance of the parameters by strain noise alone: it is drawn again, the strain smoothed again, and solved.

    Around the strain that drove the law. For records too long for a matrix. Shape (free, free).
    """
    random = np.random.default_rng(0)
    base = problem.stress(law)
    moved = []
    record = problem.record
    for _ in range(DRAWS):
        noisy = problem.excitation.true_strain + problem.excitation.strain_noise * random.standard_normal(len(record))
        again = excite(replace(record, true_strain=noisy, sha256=""), method)
        moved.append(gain @ (problem.driven_by(again).stress(law) - base))
    shifts = np.array(moved)
    return np.asarray(shifts.T @ shifts / DRAWS, dtype=np.float64)


def strain_noise_warnings(problems: Sequence[RecordProblem], law: Law) -> list[str]:
    """Where strain noise, carried to the stress by the hardening, is not small beside what else is in the residual."""
    return [
        f"{each.record.id}: strain noise of {each.excitation.strain_noise:.2g} amounts to {carried:.2g} MPa at the "
        f"largest strain; the standard errors, that of {SYMBOLS['hardening_modulus']} above all, do not include it"
        for each in problems
        if (carried := carried_at_end(each, law)) > CARRIED_NOISE * left_over(each, law)
    ]


def carried_at_end(problem: RecordProblem, law: Law) -> float:
    """Stress that the noise of one strain sample makes through the hardening at the largest strain [MPa]."""
    end = float(np.max(np.abs(problem.record.true_strain)))
    slope = law.hardening_modulus * (2.0 * np.exp(2.0 * end) + np.exp(-end))  # G d e_HT / d e, eq. (3)
    return float(problem.excitation.strain_noise * slope)


def left_over(problem: RecordProblem, law: Law) -> float:
    """What scatters a record around the law [MPa]: its noise, or its bias."""
    residual = problem.stress(law) - problem.record.true_stress
    return max(problem.noise, float(np.sqrt(np.mean(residual**2))))
