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
    from collections.abc import Callable, Mapping, Sequence

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
        noise = max(noise_level(record.time, record.true_stress - fine), least, 1e-12)
        return float(4.0 / 3.0 * np.linalg.norm(coarse - fine) / noise)  # halving the step leaves a quarter

    tolerated, first, fitted = CERTIFICATE.tolerated_scheme_error, fit.substeps, campaign.identify
    most = most_substeps(len(record.time) for record in fitted)
    steps = shared_steps(
        [partial(error_over_noise, record) for record in fitted],
        [len(record.time) for record in fitted],
        tolerated,
        first,
        most,
    )
    others = [record for record in campaign.records if record not in fitted]
    return {
        **{record.id: count for record, count in zip(fitted, steps, strict=True)},
        **{each.id: fewest_substeps(partial(error_over_noise, each), tolerated, first, most) for each in others},
    }


def shared_steps(
    errors: Sequence[Callable[[int], float]], lengths: Sequence[int], tolerated: float, first: int, most: int
) -> list[int]:
    """Steps of each record, from `first` to `most`, that leave an error of no more than `tolerated` together.

    Parameters
    ----------
    errors : sequence of callable
        Of each record, with so many steps, in the unit of `tolerated`; they fall with the square of the steps.
    lengths : sequence of int
        Samples of each record.
    """
    many, counts = np.full(len(errors), first), np.array(lengths)
    error = np.array([each(first) for each in errors])
    while np.any(free := many < most):
        # Those that have as many as can be leave the others what they do not use, or exceed it by themselves.
        left = tolerated**2 - float(np.sum(error[~free] ** 2))
        budget = np.sqrt(left) if left > 0.0 else tolerated
        if np.linalg.norm(error[free]) <= budget:
            break
        wanted = many.copy()
        few = few_instants(np.minimum(error, tolerated * most**2)[free] * many[free] ** 2, counts[free], budget)
        wanted[free] = np.clip(few, many[free], most).astype(int)
        if np.array_equal(wanted, many):
            wanted[np.argmax(np.where(free, error, -1.0))] += 1
        for at in np.flatnonzero(wanted != many):
            error[at] = errors[int(at)](int(wanted[at]))
        many = wanted
    return [int(each) for each in many]


def few_instants(size: FloatArray, lengths: NDArray[np.intp], tolerated: float) -> FloatArray:
    """Steps s of each record that leave errors c / s^2 of no more than `tolerated` together, whole numbers.

    The number of instants, sum n s, is least before rounding up: by Lagrange's multiplier s goes with (c^2 / n)^(1/5).

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
