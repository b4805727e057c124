"""The low-frequency part of a fit residual: what the law, or the experiment, leaves out, and where."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.noise.moving_parabola import moving_parabola, parabola_weights
from probation.results.data import CURVE, WithCurves
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class Bias(WithCurves):
    """Low-frequency part of one fit residual (model minus data).

    Attributes
    ----------
    low : ndarray, shape (n_times,) [MPa]
    largest_MPa : float
        Its largest absolute value.
    true_strain, time : float [-], [s]
        Where that is.
    threshold_MPa : float
        What noise alone may reach there.
    """

    low: FloatArray = field(metadata=CURVE)
    largest_MPa: float  # noqa: N815 - as it leaves the program
    true_strain: float
    time: float
    threshold_MPa: float  # noqa: N815

    @property
    def significant(self) -> bool:
        """Whether it stands out of the noise."""
        return self.largest_MPa > self.threshold_MPa

    @property
    def text(self) -> str:
        """Place and size, in words."""
        if not self.significant:
            return f"no bias above {self.threshold_MPa:.2g} MPa"
        return f"bias: at most {self.largest_MPa:.3g} MPa at a strain of {self.true_strain:.3g}"

    def to_json(self) -> dict[str, Any]:
        """Numbers only."""
        return {
            "bias_max_MPa": self.largest_MPa,
            "bias_max_at_true_strain": self.true_strain,
            "bias_max_at_time_s": self.time,
            "bias_significant": self.significant,
        }


def low_frequency(residual: FloatArray) -> FloatArray:
    """The residual through a moving parabola over `CERTIFICATE.bias_window` of the record, shape (n_times,) [MPa]."""
    if len(residual) < CERTIFICATE.fewest_for_bias:
        return np.full_like(residual, residual.mean())
    return moving_parabola(residual, _window(len(residual)))


def bias_of(
    residual: FloatArray,
    time: FloatArray,
    true_strain: FloatArray,
    long_run: float | FloatArray,
    propagated: FloatArray | None = None,
) -> Bias:
    """Size and place of the low-frequency part.

    Parameters
    ----------
    residual, time, true_strain : ndarray, shape (n_times,) [MPa], [s], [-]
    long_run : float or ndarray, shape (n_times,)
        What sqrt(m) times the mean of m neighbouring samples of the noise scatters by [MPa]: of white noise its
        standard deviation.
    propagated : ndarray, shape (n_times, n_directions), or None
        Strain noise as stress [MPa], as in `NoiseModel`.
    """
    low = low_frequency(residual)
    window = _window(len(residual))
    short = len(residual) < CERTIFICATE.fewest_for_bias
    passed = 1.0 / np.sqrt(len(residual)) if short else float(np.linalg.norm(parabola_weights(window)))
    deviation = np.full_like(low, passed * long_run)
    if not short:  # near an end the parabola is held by one side only
        deviation[: window // 2] *= 2.0
        deviation[-(window // 2) :] *= 2.0
        if propagated is not None and propagated.shape[1]:
            deviation = np.hypot(deviation, np.linalg.norm(moving_parabola(propagated, window), axis=1))
    threshold = CERTIFICATE.bias_significant * deviation
    stands_out = np.abs(low) > threshold
    at = int(np.argmax(np.where(stands_out, np.abs(low), 0.0) if stands_out.any() else np.abs(low)))
    return Bias(low, float(abs(low[at])), float(true_strain[at]), float(time[at]), float(threshold[at]))


def _window(count: int) -> int:
    return max(2 * int(0.5 * CERTIFICATE.bias_window * count) + 1, 5)
