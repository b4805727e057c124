"""The records of a model seen through their noise, the base parameters refitted: lengths of effects' signals."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.design.effect_signals import signal
from probation.errors import InputError
from probation.inference.information import inverse_information
from probation.inference.view_residual import residual_of
from probation.noise.span import DEPENDENT
from probation.noise.whitener import Whitener
from probation.noise.whitening import Whitened
from probation.settings.design import DESIGN

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.design.effect_signals import EffectSignal
    from probation.inference.model import CampaignModel
    from probation.noise.model import NoiseModel

NOTHING = 1e-6
"""Part of a signal that is left by a refit below which it is rounding."""

CLOSE = 1.02
"""How near to the length from which on it is seen the smallest amplitude is found."""

_REFINED = 20


@dataclass(frozen=True)
class OmissionBias:
    """How far a base parameter is off if the effect is there and left out.

    Attributes
    ----------
    percent : float
        Of its value; NaN where that is 0.
    standard_errors : float
        NaN where the records do not depend on the parameter.
    """

    parameter: str
    percent: float
    standard_errors: float

    def to_dict(self) -> dict[str, object]:
        """For JSON."""
        return {
            "parameter": self.parameter,
            "percent": self.percent,
            "standard_errors": self.standard_errors,
        }


@dataclass(frozen=True, eq=False)
class Design:
    """A model at its parameters, seen through the noise of its records.

    Attributes
    ----------
    tangent : ndarray, shape (n_samples, n_parameters)
        Whitened derivatives along the model's parameters.
    """

    model: CampaignModel
    parameters: FloatArray
    white: Whitened
    tangent: FloatArray

    @classmethod
    def of(cls, model: CampaignModel, parameters: FloatArray, noises: Sequence[NoiseModel]) -> Design:
        """A model at its parameters, with one noise per record."""
        residual, tangent = model.residual_and_jacobian(parameters)
        records = [residual_of(view, residual[rows], tangent[rows]) for view, rows in model.parts]
        white = Whitened.of(records, noises)
        return cls(model, parameters, white, Whitener(white.noises).columns(tangent))

    def covariance(self) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Covariance of generalised least squares (p, p), and which parameters the records do not determine (p,)."""
        size = np.where(self.parameters != 0.0, np.abs(self.parameters), 1.0)
        inverse, lost, _ = inverse_information(self.tangent * size)
        return inverse * np.outer(size, size), lost

    def whitened(self, columns: FloatArray) -> FloatArray:
        """Stresses (n_samples, m) in white coordinates."""
        return Whitener(self.white.noises).columns(columns)

    def left_of(self, raw: FloatArray) -> tuple[FloatArray, FloatArray]:
        """What a refit leaves of whitened columns (n_samples, m), and its lengths (m,); rounding counts as nothing."""
        left = self.white.project(raw)
        sizes, full = np.linalg.norm(left, axis=0), np.linalg.norm(raw, axis=0)
        nothing = sizes <= NOTHING * full
        left[:, nothing], sizes[nothing] = 0.0, 0.0
        return left, sizes

    def biases(self, raw: FloatArray) -> tuple[OmissionBias, ...]:
        """Where a refit without the effect ends, the largest share of a parameter's value first."""
        scale = np.linalg.norm(self.tangent, axis=0)
        scale[scale == 0.0] = 1.0
        inverse = np.linalg.pinv(self.tangent / scale, rcond=DEPENDENT) / scale[:, None]
        shift, se = inverse @ raw, np.linalg.norm(inverse, axis=1)
        with np.errstate(divide="ignore", invalid="ignore"):
            percent = np.where(self.parameters != 0.0, 100.0 * shift / self.parameters, np.nan)
            errors = shift / se
        rows = zip(self.model.parameter_names, percent.tolist(), errors.tolist(), strict=True)
        return tuple(sorted((OmissionBias(*row) for row in rows), key=lambda bias: -abs(np.nan_to_num(bias.percent))))

    def smallest_seen(self, usual: EffectSignal, size: float) -> tuple[float, FloatArray] | None:
        """Least amplitude that is seen, with the nonlinear parameters of `usual`, of length `size`; and what is left.

        By the slope from zero and, where that fails (an effect with a threshold), by halving; None beyond the bounds,
        or beyond what the law can be solved with.
        """
        try:
            return self._search(usual, size)
        except InputError:
            return None

    def _search(self, usual: EffectSignal, size: float) -> tuple[float, FloatArray] | None:
        end = usual.cause.form.amplitude.upper if usual.values[0] > 0.0 else usual.cause.form.amplitude.lower
        unseen, amplitude = 0.0, usual.values[0]
        if size < DESIGN.detected:
            guess = np.clip(amplitude * 1.01 * DESIGN.detected / max(size, 1e-300), min(0.0, end), max(0.0, end))
            unseen, amplitude = amplitude, float(guess)
            size = self._length(usual, amplitude)
            if size < DESIGN.detected:
                unseen, amplitude = amplitude, end
                size = self._length(usual, amplitude)
        if size < DESIGN.detected:
            return None
        for _ in range(_REFINED):
            if size < CLOSE * DESIGN.detected:
                break
            guess = amplitude * 0.5 * (1.0 + CLOSE) * DESIGN.detected / size
            if not abs(guess) > abs(unseen):
                guess = 0.5 * (unseen + amplitude)
            length = self._length(usual, guess)
            if length < DESIGN.detected:
                unseen = guess
            else:
                amplitude, size = guess, length
        return amplitude, self._left(usual, amplitude)

    def _length(self, usual: EffectSignal, amplitude: float) -> float:
        return float(np.linalg.norm(self._left(usual, amplitude)))

    def _left(self, usual: EffectSignal, amplitude: float) -> FloatArray:
        stress = signal(self.model, self.parameters, usual.cause, (amplitude, *usual.values[1:]))
        return np.asarray(self.left_of(self.whitened(stress[:, None]))[0][:, 0])
