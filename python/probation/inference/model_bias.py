"""How far the bias of a law may have pulled its parameters.

Least squares hides the part of a bias that looks like a parameter. What is left says how large the bias is; the hidden
part is taken to be of the same kind (Kennedy & O'Hagan 2001): smooth waves along the record whose energy falls with
their order as that of a diagnosis's discrepancy does.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import softmax

from probation.inference.discrepancy import spectra
from probation.noise.smooth_basis import smooth_basis
from probation.noise.span import span_of, without
from probation.settings.certificate import CERTIFICATE
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray

ENERGIES = np.append(0.0, np.geomspace(*EVIDENCE.unknown_range, 81))
"""Energies of a bias that are tried, in variances of the noise of a sample."""


@dataclass(frozen=True, eq=False)
class ModelBias:
    """The bias of a law on one record.

    Attributes
    ----------
    amplitude : float
        Root mean square along the record [MPa].
    covariance : ndarray, shape (free, free)
        Of the parameters, by the bias alone.
    """

    amplitude: float
    covariance: FloatArray


def model_bias(
    residual: FloatArray, slopes: FloatArray, noise: float, time: FloatArray, jumps: Sequence[int] = ()
) -> ModelBias:
    """Estimate the bias that a fit left on one record, by restricted likelihood over its energy and its softness.

    Parameters
    ----------
    residual : ndarray, shape (n,) [MPa]
        Of a fit by least squares.
    slopes : ndarray, shape (n, free) [MPa per unit]
        Along the parameters that were identified.
    noise : float
        Standard deviation of the noise [MPa].
    time : ndarray, shape (n,) [s]
    jumps : sequence of int
        Where the strain rate jumps.
    """
    noise = max(noise, 1e-12)
    basis = smooth_basis(time, jumps, EVIDENCE.roughest_discrepancy)
    waves = basis.columns / np.linalg.norm(basis.columns, axis=0)
    size = np.linalg.norm(slopes, axis=0)
    size[size == 0.0] = 1.0
    pulled = np.linalg.pinv(slopes / size) @ waves / size[:, None]
    hidden = span_of(slopes)
    left = without(residual, hidden) / noise
    visible = max(float(left @ left) - len(left), 1.0)
    prior = np.zeros_like(ENERGIES)
    # The energy of the whole is not likely to be much larger than what shows of it.
    prior[1:] = -0.5 * (0.5 * np.log(ENERGIES[1:] / visible) / CERTIFICATE.hidden_bias_spread) ** 2
    shares = spectra(basis.order)
    best, score = np.empty(len(shares)), np.empty(len(shares))
    for at, share in enumerate(shares):
        seen, deviation, _ = np.linalg.svd(without(waves, hidden) * np.sqrt(share), full_matrices=False)
        variance = 1.0 + ENERGIES[:, None] * deviation**2
        scores = prior - 0.5 * np.sum(np.log(variance) + (seen.T @ left) ** 2 / variance, axis=1)
        best[at], score[at] = ENERGIES[np.argmax(scores)], scores.max()
    energies = noise**2 * softmax(score) * best
    return ModelBias(
        amplitude=float(np.sqrt(energies.sum() / len(residual))),
        covariance=np.asarray((pulled * (energies @ shares)) @ pulled.T),
    )
