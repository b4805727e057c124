"""Steps of the scheme from sample to sample that keep its own error from being taken for an effect."""

from __future__ import annotations

from functools import partial
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

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.identify.result import Fit
    from probation.records.campaign import Campaign
    from probation.records.record import Record
    from probation.smoothing.excitation import Excitation


def enough_substeps(campaign: Campaign, fit: Fit, excitations: Mapping[str, Excitation]) -> dict[str, int]:
    """Substeps in each record for a scheme of order 2, at least those of the fit; by record id.

    A fit takes as many as its standard errors ask for, which are wide where there is a gap; the noise asks for more.
    The error over the noise of all fitted records together is what counts, a held-out record's by itself.

    Parameters
    ----------
    fit : Fit
        Of the base law.
    excitations : dict of str to Excitation
        By record id, at the samples.
    """

    def error_over_noise(record: Record, steps: int) -> float:
        coarse, fine = (predicted(fit, excitations[record.id], count) for count in (steps, 2 * steps))
        least = NOISE.least_noise * float(np.max(np.abs(record.true_stress)))
        noise = max(noise_level(record.time, record.true_stress - fine), least)
        return float(4.0 / 3.0 * np.linalg.norm(coarse - fine) / noise)  # halving the step leaves a quarter

    tolerated, first, fitted = CERTIFICATE.tolerated_scheme_error, fit.substeps, campaign.identify
    most = most_substeps(len(record.time) for record in fitted)
    lengths = np.array([len(record.time) for record in fitted])
    steps = np.full(len(fitted), first)
    error = np.array([error_over_noise(record, first) for record in fitted])
    while np.linalg.norm(error) > tolerated and np.any(steps < most):
        wanted = np.clip(fewest_instants(error * steps**2, lengths, tolerated), steps, most).astype(int)
        if np.array_equal(wanted, steps):
            wanted[np.argmax(np.where(steps < most, error, -1.0))] += 1
        changed = np.flatnonzero(wanted != steps)
        steps = wanted
        error[changed] = [error_over_noise(fitted[at], int(steps[at])) for at in changed]
    others = [record for record in campaign.records if record not in fitted]
    return {
        **{record.id: int(count) for record, count in zip(fitted, steps, strict=True)},
        **{each.id: fewest_substeps(partial(error_over_noise, each), tolerated, first, most) for each in others},
    }


def fewest_instants(size: FloatArray, lengths: NDArray[np.intp], tolerated: float) -> FloatArray:
    """Steps s of each record that leave the errors c / s^2 of all together no more than `tolerated`, whole numbers.

    With fewest instants, sum n s: by Lagrange's multiplier s is proportional to (c^2 / n)^(1/5).

    Parameters
    ----------
    size : ndarray, shape (n_records,)
        c, in the unit of `tolerated`.
    lengths : ndarray of int, shape (n_records,)
        n, samples.
    tolerated : float
    """
    share = np.maximum(size**2 / lengths, 1e-300) ** 0.2
    return np.asarray(np.ceil(share * float(np.sum(size**2 / share**4)) ** 0.25 / np.sqrt(tolerated)))


def predicted(fit: Fit, excitation: Excitation, substeps: int) -> FloatArray:
    """The fitted law's stress at the samples, shape (n_samples,) [MPa]."""
    fine = excitation.refined(substeps)
    stress = fit.law.stress(fine, scheme=scheme_of(fit.scheme, fit.start))
    return np.asarray(stress[::substeps])
