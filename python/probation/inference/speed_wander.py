"""A machine's speed that wanders at one frequency by less than the noise of the strain shows.

The specimen feels it, and the force shows a line where the law is stiff. The smoother cannot know of it, nor does its
error: that is the mean over all frequencies, none of which stands out.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.propagated import stress_by_errors
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw


def speed_wander(law: GapLaw, view: RecordView, parameters: FloatArray) -> FloatArray | None:
    """Stress by a speed that wanders as a cosine and a sine of 1, 2, … cycles, shape (n_samples, 2 cycles) [MPa].

    Of one standard deviation each: `NOISE.speed_wander` of the speed, as far as the strain's noise hides it. Only one
    of the frequencies is ever meant. None where the strain is as measured: it drives the law with its wander.

    Parameters
    ----------
    law : GapLaw
    view : RecordView
    parameters : ndarray, shape (n_base,)
    """
    excitation = view.excitation
    if excitation.errors is None or excitation.strain_rate is None:
        return None
    time = excitation.time
    phase = 2.0 * np.pi * np.outer((time - time[0]) / (time[-1] - time[0]), np.arange(1, NOISE.wander_cycles + 1))
    speed = excitation.strain_rate[:, None] * np.hstack([np.cos(phase), np.sin(phase)])
    steps = 0.5 * (speed[1:] + speed[:-1]) * np.diff(time)[:, None]
    strain = np.vstack([np.zeros_like(speed[:1]), np.cumsum(steps, axis=0)])
    shown = np.sum((strain - strain.mean(axis=0)) ** 2, axis=0)
    noise = excitation.strain_noise**2 * excitation.noise_inflation
    size = (NOISE.speed_wander**-2.0 + shown / noise) ** -0.5
    return stress_by_errors(law, view, parameters, size * strain, size * speed)
