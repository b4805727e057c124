"""Direct prediction: the law with parameters from elsewhere against a record, nothing adjusted (Figures 4a, 4b)."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.certificate.fits import companion_factor, free_parameters
from probation.identify.modelled_record import ModelledRecord
from probation.inference.measured_view import measured_view
from probation.inference.modal_law import DnlrLaw
from probation.law.schemes import scheme_of
from probation.results.data import CURVE, from_curves

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.calibration.calibrated import CalibratedCompanion
    from probation.identify.result import Fit
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation


@dataclass(frozen=True, eq=False)
class Prediction(ModelledRecord):
    """A record with what the law predicts for it.

    Its `bias_MPa` is the systematic part of the error.

    Attributes
    ----------
    standard_error : ndarray, shape (n_times,) [MPa]
        Of the prediction, by the uncertainty of the parameters and of the companion relation.
    tolerance_MPa : float
        The systematic error that is let pass.
    identified_on : tuple of str
        Where the parameters come from.
    """

    standard_error: FloatArray = field(metadata=CURVE)
    tolerance_MPa: float  # noqa: N815 - as it leaves the program
    identified_on: tuple[str, ...]

    @property
    def worst(self) -> int:
        """Sample of the largest error."""
        return int(np.argmax(np.abs(self.fit_residual)))

    @from_curves
    def largest_at(self) -> dict[str, float]:
        """Where the largest error is, and the standard error of the prediction there."""
        return {
            "time_s": float(self.time[self.worst]),
            "true_strain": float(self.true_strain[self.worst]),
            "standard_error_MPa": float(self.standard_error[self.worst]),
        }

    @property
    def noise_units(self) -> float:
        """The error over the noise, both root mean square."""
        return self.rms_MPa / self.noise_MPa if self.noise_MPa > 0.0 else np.inf

    @property
    def relative(self) -> float:
        """The systematic error over the largest stress of the record."""
        return self.bias_MPa / self.largest_stress_MPa

    @property
    def passes(self) -> bool:
        """Whether the systematic error stays within the tolerance."""
        return self.bias_MPa <= self.tolerance_MPa

    def to_json(self) -> dict[str, Any]:
        """Numbers only."""
        return {
            "rms_MPa": self.rms_MPa,
            "max_MPa": self.max_MPa,
            "noise_MPa": self.noise_MPa,
            "systematic_MPa": self.bias_MPa,
            "in_noise_units": self.noise_units,
            "tolerance_MPa": self.tolerance_MPa,
            "passes": self.passes,
            "largest_at": self.largest_at,
            "identified_on": list(self.identified_on),
        }


def predict(
    base: Fit,
    covariance: FloatArray,
    record: Record,
    tolerance: float,
    excitation: Excitation,
    relation: CalibratedCompanion | None = None,
) -> Prediction:
    """Predict a record with the law of a fit.

    Parameters
    ----------
    covariance : ndarray, shape (free, free)
        Of its parameters, `fits.joint_covariance`.
    tolerance : float
        Error that is let pass, as a fraction of the record's largest stress.
    excitation : Excitation
        What drives the law along it.
    relation : CalibratedCompanion, optional
        What is known of the law's companion relation.
    """
    view = measured_view(record, excitation, scheme_of(base.scheme, base.start), base.substeps)
    stress, sensitivity = (view.sampled(values) for values in DnlrLaw(base.law).sensitivity(view, base.law.parameters))
    slopes = sensitivity[:, free_parameters(base)]
    variance = np.einsum("ij,jk,ik->i", slopes, covariance, slopes)
    variance += np.sum(companion_factor(base, view.excitation, relation) ** 2, axis=1)
    return Prediction(
        id=record.id,
        time=record.time,
        true_strain=record.true_strain,
        true_stress=record.true_stress,
        excitation=view.excitation,
        model_stress=stress,
        standard_error=np.sqrt(np.maximum(variance, 0.0)),
        noise_MPa=view.stress_noise,
        tolerance_MPa=tolerance * float(np.max(np.abs(record.true_stress))),
        identified_on=tuple(base.records),
    )
