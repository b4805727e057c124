"""A record with the stress of a law, identified on it or not, and how far the two are apart."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from probation.results.data import CURVE, WithCurves, from_curves

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.smoothing.excitation import Excitation


@dataclass(frozen=True, eq=False)
class ModelledRecord(WithCurves):
    """A record and what a law makes of it.

    Attributes
    ----------
    time, true_strain, true_stress : ndarray, shape (n_times,) [s], [-], [MPa]
        As measured.
    excitation : Excitation
        What drove the law.
    model_stress : ndarray, shape (n_times,) [MPa]
    noise_MPa : float
        Standard deviation of what of the difference is noise.
    """

    id: str
    time: FloatArray = field(metadata=CURVE)
    true_strain: FloatArray = field(metadata=CURVE)
    true_stress: FloatArray = field(metadata=CURVE)
    excitation: Excitation
    model_stress: FloatArray = field(metadata=CURVE)
    noise_MPa: float  # noqa: N815 - as it leaves the program

    @property
    def fit_residual(self) -> FloatArray:
        """Model minus data, shape (n_times,) [MPa]."""
        return self.model_stress - self.true_stress

    @from_curves
    def rms_MPa(self) -> float:
        """Root mean square of the fit residual."""
        return float(np.sqrt(np.mean(self.fit_residual**2)))

    @from_curves
    def max_MPa(self) -> float:
        """Largest fit residual."""
        return float(np.max(np.abs(self.fit_residual)))

    @from_curves
    def samples(self) -> int:
        """How many there are."""
        return len(self.time)

    @from_curves
    def largest_stress_MPa(self) -> float:
        """Largest measured stress, without its sign."""
        return float(np.max(np.abs(self.true_stress)))

    @from_curves
    def rate_jumps_s(self) -> tuple[float, ...]:
        """Instants at which the strain rate is discontinuous [s]."""
        return tuple(float(self.time[jump]) for jump in self.excitation.jumps)

    @property
    def bias_MPa(self) -> float:
        """What of the fit residual is not noise, root mean square."""
        return float(np.sqrt(max(self.rms_MPa**2 - self.noise_MPa**2, 0.0)))
