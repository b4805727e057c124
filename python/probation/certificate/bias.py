"""What a model's bias does to its parameters: the wave that a law leaves behind, and how far it may have pulled them.

Least squares hides the part of a bias that looks like a parameter. What is left says how large the bias is and how
fast it waves; the hidden part is taken to be of the same kind (Kennedy & O'Hagan 2001: a Gaussian process).
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.identify.record_fit import RecordFit


LENGTHS = np.geomspace(*CERTIFICATE.bias_lengths, 8)
"""Correlation lengths that are weighed against each other, as fractions of the record."""


RATIOS = np.geomspace(*CERTIFICATE.bias_variances, 91)
"""Variances of the bias over that of a block's noise that are searched."""


@dataclass(frozen=True, eq=False)
class ModelBias:
    """The bias of a law on one record, as a Gaussian process along the record.

    Attributes
    ----------
    amplitude : float
        Standard deviation [MPa].
    length : float
        Correlation length, as a fraction of the record.
    covariance : ndarray, shape (free, free)
        Of the parameters, by the bias alone.
    """

    amplitude: float
    length: float
    covariance: FloatArray


def model_bias(record: RecordFit, free: Sequence[int]) -> ModelBias:
    """Estimate the bias that a fit left on a record, by restricted maximum likelihood over amplitude and length.

    Parameters
    ----------
    record : RecordFit
        Fitted alone.
    free : sequence of int
        Columns of its sensitivity that were identified.
    """
    count = len(record.time)
    borders = np.unique(np.linspace(0, count, min(CERTIFICATE.bias_blocks, count) + 1).astype(int))

    def means(values: FloatArray) -> FloatArray:
        return np.array([values[first:last].mean(axis=0) for first, last in pairwise(borders)])

    place = means(_place(record))
    residual, slopes = means(record.fit_residual), means(record.sensitivity[:, list(free)])
    stress = means(record.true_stress)
    size = np.linalg.norm(slopes, axis=0)
    size[size == 0.0] = 1.0
    noise = max(record.noise_MPa, 1e-12) ** 2 * len(residual) / count
    rotation = np.linalg.qr(slopes / size, mode="complete")[0]
    left = rotation[:, slopes.shape[1] :]  # what least squares does not hide
    seen = left.T @ residual

    evidence, variances = np.empty(len(LENGTHS)), np.empty(len(LENGTHS))
    # No stress, no bias: it sets in with the stress and reaches its full size at the median.
    size_of_bias = np.minimum(np.abs(stress) / max(float(np.median(np.abs(stress))), 1e-300), 1.0)
    kernels = [_kernel(place, length) * np.outer(size_of_bias, size_of_bias) for length in LENGTHS]
    visible = max(float(np.mean(seen**2)) - noise, 0.0)
    for at, kernel in enumerate(kernels):
        spread, basis = np.linalg.eigh(left.T @ kernel @ left)
        spread = np.maximum(spread, 0.0)
        power = (basis.T @ seen) ** 2
        total = noise * (1.0 + RATIOS[:, None] * spread)
        score = -0.5 * np.sum(np.log(total) + power / total, axis=1)
        if visible > 0.0:  # it is not likely to be much larger than what shows of it
            score -= 0.5 * (0.5 * np.log(RATIOS * noise / visible) / CERTIFICATE.hidden_bias_spread) ** 2
        best = int(np.argmax(score))
        nothing = -0.5 * np.sum(np.log(noise) + power / noise)
        evidence[at], variances[at] = score[best], RATIOS[best] * noise
        if nothing >= score[best]:
            evidence[at], variances[at] = nothing, 0.0
    weight = np.exp(evidence - evidence.max())
    weight /= weight.sum()
    influence = np.linalg.pinv(slopes / size) / size[:, None]
    covariance = sum(
        share * variance * influence @ kernel @ influence.T
        for share, variance, kernel in zip(weight, variances, kernels, strict=True)
    )
    variance = float(weight @ variances)
    return ModelBias(float(np.sqrt(variance)), float(weight @ LENGTHS), np.asarray(covariance))


def _kernel(place: FloatArray, length: float) -> FloatArray:
    """Squared-exponential correlation of unit variance."""
    kernel: FloatArray = np.exp(-0.5 * ((place[:, None] - place) / length) ** 2)
    return kernel


def _place(record: RecordFit) -> FloatArray:
    """Where a sample stands in its record, 0 to 1: by time and by the path of its strain, half each."""
    time = (record.time - record.time[0]) / np.ptp(record.time)
    path = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(record.excitation.true_strain)))])
    place: FloatArray = 0.5 * (time + path / path[-1]) if path[-1] > 0.0 else time
    return place
