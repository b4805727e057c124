"""What an explanation that acts at an instant of its own loses where the noise is larger than elsewhere.

A slip is sought along the whole record, so it is found where the noise is largest: in a burst that the noise model has
missed. There the noise has v times the variance that whitening takes it to have, and an amplitude of t standard errors
is one of t / sqrt(v). By the ratio of Savage and Dickey (Dickey 1971) the evidence for it is then smaller by

    t^2 (1 - 1/v) / 2 - ln(v) / 2,

and by v ln(n) at most, n the number of samples: in a burst chance reaches t^2 = 2 v ln(n), and no more.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.instants import INSTANT
from probation.noise.local_noise import median_local_variance, samples_within
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.refit import Refit


def lost_to_local_noise(refit: Refit, covariance: FloatArray) -> float:
    """Log evidence that the causes of a refit lose, all together; not below 0.

    Parameters
    ----------
    refit : Refit
    covariance : ndarray, shape (p, p)
        Of its search coordinates; a parameter at a bound has none.
    """
    at = refit.model.base_count
    lost = 0.0
    for cause in refit.model.causes:
        amplitude, at = at, at + len(cause.form.parameters)
        if all(parameter.name != INSTANT.name for parameter in cause.form.parameters):
            continue
        signal = refit.jacobian[:, [amplitude]]
        size, variance = float(np.linalg.norm(signal)), float(covariance[amplitude, amplitude])
        if size == 0.0 or variance <= 0.0:
            continue
        if samples_within(signal / size)[0] > EVIDENCE.samples_of_a_short_signal:
            continue
        around = median_local_variance(signal[:, 0] / size, refit.residual, refit.problem.whitener.slices)
        noise = min(max(around, 1.0), EVIDENCE.largest_local_variance)
        square = float(refit.coordinates.of(refit.parameters)[amplitude]) ** 2 / variance
        by_ratio = 0.5 * square * (1.0 - 1.0 / noise) - 0.5 * float(np.log(noise))
        lost += max(min(by_ratio, noise * float(np.log(len(refit.residual)))), 0.0)
    return lost
