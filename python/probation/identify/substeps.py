"""Steps of the scheme from sample to sample that keep its own error from being taken for an effect."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.scheme_error import most_substeps
from probation.law.refinement import fewest_substeps
from probation.law.schemes import scheme_of
from probation.records.noise import noise_level
from probation.settings.certificate import CERTIFICATE
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Mapping

    from probation._arrays import FloatArray
    from probation.identify.result import Fit
    from probation.records.campaign import Campaign
    from probation.smoothing.excitation import Excitation


def enough_substeps(campaign: Campaign, fit: Fit, excitations: Mapping[str, Excitation]) -> int:
    """Substeps for a scheme of order 2, at least those of the fit.

    A fit takes as many as its standard errors ask for, which are wide where there is a gap; the noise asks for more.

    Parameters
    ----------
    fit : Fit
        Of the base law.
    excitations : dict of str to Excitation
        By record id, at the samples.
    """

    def error_over_noise(steps: int) -> float:
        square = 0.0
        for record in campaign.identify:
            coarse, fine = (predicted(fit, excitations[record.id], count) for count in (steps, 2 * steps))
            least = NOISE.least_noise * float(np.max(np.abs(record.true_stress)))
            noise = max(noise_level(record.time, record.true_stress - fine), least)
            square += float(np.sum((coarse - fine) ** 2)) / noise**2
        return float(4.0 / 3.0 * np.sqrt(square))  # halving the step leaves a quarter of the error

    most = most_substeps(len(record.time) for record in campaign.identify)
    return fewest_substeps(error_over_noise, CERTIFICATE.tolerated_scheme_error, fit.substeps, most)


def predicted(fit: Fit, excitation: Excitation, substeps: int) -> FloatArray:
    """The fitted law's stress at the samples, shape (n_samples,) [MPa]."""
    fine = excitation.refined(substeps)
    stress = fit.law.stress(fine, scheme=scheme_of(fit.scheme, fit.start))
    return np.asarray(stress[::substeps])
