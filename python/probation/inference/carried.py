"""What a smoothed strain's noise does to the stress."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.noise.estimate import carried_strain_noise

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw
    from probation.smoothing.excitation import Excitation

STRAIN_STEP = 1e-6
"""Strain by which the law is probed."""


def carried_noise(law: GapLaw, view: RecordView, excitation: Excitation, parameters: FloatArray) -> FloatArray | None:
    """Stress noise A A^T that a smoothed strain's noise makes, A of shape (n_samples, waves) [MPa].

    Parameters
    ----------
    law : GapLaw
    view : RecordView
    excitation : Excitation
        The record's.
    parameters : ndarray, shape (n_base,)

    Returns
    -------
    ndarray or None
        None where the strain is as measured.
    """
    if excitation.operators is None or not excitation.strain_noise > 0.0:
        return None
    still = law.stress(view, parameters)
    instants, samples = view.time, view.sampled(view.time)

    def apply(columns: FloatArray) -> FloatArray:
        found = np.empty_like(columns)
        for index, column in enumerate(columns.T):
            size = max(float(np.max(np.abs(column))), 1e-300)
            moved = view.true_strain + STRAIN_STEP / size * np.interp(instants, samples, column)
            found[:, index] = view.sampled(law.stress(view.driven(moved), parameters) - still) * (size / STRAIN_STEP)
        return found

    deviation = excitation.strain_noise * np.sqrt(excitation.noise_inflation)
    return carried_strain_noise(apply, deviation, len(samples))
