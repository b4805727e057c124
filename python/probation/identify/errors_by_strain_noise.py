"""What noise of the measured strain adds to the errors of the parameters."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.modal_law import DnlrLaw
from probation.inference.parameter import SYMBOLS
from probation.settings.certificate import CERTIFICATE
from probation.smoothing.excitation import excite

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.strain_noise import StrainNoise
    from probation.law.modal import Law
    from probation.smoothing.methods import Method as ExcitationMethod


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
        propagated = noise.probed(law, 8)
        moved = np.sqrt(np.mean((gain @ propagated) ** 2, axis=1))
    else:
        moved = np.linalg.norm(gain @ noise.propagated(law), axis=1)
    share: FloatArray = np.divide(moved, error, out=np.full_like(moved, np.inf), where=error > 0.0)
    return share


def resampled(view: RecordView, law: Law, gain: FloatArray, method: ExcitationMethod) -> FloatArray:
    """Covariance of the parameters by strain noise alone: it is drawn again, the strain smoothed again, and solved.

    Around the strain that drove the law. For records too long for a matrix. Shape (free, free).
    """
    random = np.random.default_rng(0)
    base = _stress(view, law)
    moved = []
    record, drive = view.record, view.excitation
    for _ in range(CERTIFICATE.strain_draws):
        noisy = drive.true_strain + drive.strain_noise * random.standard_normal(len(record))
        again = excite(replace(record, true_strain=noisy, sha256=""), method)
        moved.append(gain @ (_stress(view.smoothed_as(again), law) - base))
    shifts = np.array(moved)
    return np.asarray(shifts.T @ shifts / CERTIFICATE.strain_draws, dtype=np.float64)


def strain_noise_warnings(views: Sequence[RecordView], law: Law) -> list[str]:
    """Where strain noise, propagated to the stress by the hardening, is not small against the rest of the residual."""
    return [
        f"{view.record.id}: strain noise of {view.excitation.strain_noise:.2g} amounts to {propagated:.2g} MPa at the "
        f"largest strain; the standard errors, that of {SYMBOLS['hardening_modulus']} above all, do not include it"
        for view in views
        if (propagated := propagated_at_end(view, law)) > CERTIFICATE.strain_noise_matters * left_over(view, law)
    ]


def propagated_at_end(view: RecordView, law: Law) -> float:
    """Stress that the noise of one strain sample makes through the hardening at the largest strain [MPa]."""
    end = float(np.max(np.abs(view.record.true_strain)))
    slope = law.hardening_modulus * (2.0 * np.exp(2.0 * end) + np.exp(-end))  # G d e_HT / d e, eq. (3)
    return float(view.excitation.strain_noise * slope)


def left_over(view: RecordView, law: Law) -> float:
    """What scatters a record around the law [MPa]: its noise, or its bias."""
    return max(view.stress_noise, float(np.sqrt(np.mean((_stress(view, law) - view.data) ** 2))))


def _stress(view: RecordView, law: Law) -> FloatArray:
    return view.sampled(DnlrLaw(law).stress(view, law.parameters))
