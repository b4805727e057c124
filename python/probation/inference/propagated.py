"""What the noise of the measured strain does to the stress that a law predicts: A A^T = J_eps Sigma_eps J_eps^T."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.modal_law import DnlrLaw
from probation.inference.strain_noise import leading_directions, solver_on_samples, tangents_along
from probation.records.noise import noise_level
from probation.settings.noise import NOISE
from probation.settings.smoothing import SMOOTHING

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.protocol import GapLaw

ROUNDING = 1e-14
"""Variance of a direction over the largest one's that is nothing but rounding."""

STRAIN_STEP = 1e-6
"""Largest strain by which a law without tangents is probed [-]."""


def propagated_noise(law: GapLaw, view: RecordView, parameters: FloatArray) -> FloatArray | None:
    """Factor A of the stress covariance A A^T that the strain's noise makes, shape (n_samples, n_directions) [MPa].

    Of a smoothed strain all that the smoother leaves unknown; of a strain as measured the error of its first sample,
    which shifts the whole record: the rest of it is as rough as the stress noise and is measured with that.

    Parameters
    ----------
    law : GapLaw
    view : RecordView
    parameters : ndarray, shape (n_base,)

    Returns
    -------
    ndarray or None
        None where the strain has no noise.
    """
    if view.excitation.strain_noise < SMOOTHING.clean:
        return None
    columns = stress_by_errors(law, view, parameters, *leading_directions(view.excitation))
    variance, turn = np.linalg.eigh(columns.T @ columns)
    level = noise_level(view.sampled(view.time), view.data)
    kept = (variance > (NOISE.negligible_propagated * level) ** 2) & (variance > ROUNDING * variance[-1:])
    return np.asarray(columns @ turn[:, kept])


def stress_by_errors(
    law: GapLaw, view: RecordView, parameters: FloatArray, strain: FloatArray, rate: FloatArray | None
) -> FloatArray:
    """Stress that a law makes of errors of the strain and of its rate, shape (n_samples, m) [MPa].

    Parameters
    ----------
    strain, rate : ndarray, shape (n_samples, m) [-], [1/s]
        A law without tangents along the strain takes the rate from it.
    """
    if isinstance(law, DnlrLaw):
        solver = solver_on_samples(view.excitation, view.scheme, view.stride)
        return tangents_along(solver, law.law_at(parameters), strain, rate)
    still = law.stress(view, parameters)
    instants, samples = view.time, view.sampled(view.time)
    stress = np.empty_like(strain)
    for index, column in enumerate(strain.T):
        size = max(float(np.max(np.abs(column))), 1e-300)
        moved = view.true_strain + STRAIN_STEP / size * np.interp(instants, samples, column)
        stress[:, index] = view.sampled(law.stress(view.driven(moved), parameters) - still) * (size / STRAIN_STEP)
    return stress
