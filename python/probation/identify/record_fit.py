"""`RecordFit`: one record against the identified law."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

from probation._short_repr import ShortRepr
from probation.identify.modelled_record import ModelledRecord
from probation.noise.whiteness import mean_inflation
from probation.results.data import CURVE, from_curves

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.identify.bias import Bias


@dataclass(frozen=True, eq=False)
class RecordFit(ShortRepr, ModelledRecord):
    """One record against the identified law.

    Its `noise_MPa` is the high-frequency part of the fit residual; all of it where the noise model (correlation,
    strain noise) leaves nothing else.

    Attributes
    ----------
    sensitivity : ndarray, shape (n_times, 3) [MPa per unit]
        Along E_u, tau_max or alpha, G.
    bias : Bias
        The low-frequency part: size and place.
    noise_correlation : float
        Of the stress noise from sample to sample; 0 where none was found.
    strain_noise_weighed : bool
        Whether the residual was weighed for the strain's noise.
    """

    sensitivity: FloatArray = field(metadata=CURVE)
    bias: Bias
    noise_correlation: float = 0.0
    strain_noise_weighed: bool = False

    @from_curves
    def effective_samples(self) -> float:
        """Independent samples that would say as much of the scatter around the law."""
        return self.samples / mean_inflation(self.fit_residual)

    def to_json(self) -> dict[str, Any]:
        """Numbers only."""
        return {
            "rms_MPa": self.rms_MPa,
            "max_MPa": self.max_MPa,
            "noise_MPa": self.noise_MPa,
            "bias_MPa": self.bias_MPa,
            **self.bias.to_json(),
            "noise_correlation": self.noise_correlation,
            "strain_noise_weighed": self.strain_noise_weighed,
            "differentiator": self.excitation.differentiator,
            "strain_noise": self.excitation.strain_noise,
            "rate_jumps_s": list(self.rate_jumps_s),
        }
