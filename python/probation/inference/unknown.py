"""An effect outside the catalogue: whatever it does, it does it smoothly, or from specimen to specimen.

It may be one function of the strain in all records; periodic in the strain, as teeth are; other parameters of the law
in each record; a smooth discrepancy in one record, of one size in all, or of its own size in each. Which of these
nobody knows beforehand, so that each has a share of the prior and its size is integrated over: what a few numbers tell
earns more than what takes many.

In white coordinates the covariances are I + s C C^T: C waves over the strain, the strain-periodic component (if it is
more than a line in time), or the records' own tangents; and I + s B diag(v) B^T, B smooth waves along all records or
one, v their spectrum (`Discrepancy`). s takes the values of `SIZES`; a size of its own in each record is its best one,
for the price of the choice. The law's parameters are free, and so are errors of the forms of known effects.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import logsumexp

from probation.inference.laplace import Linearised
from probation.noise.span import span_of, without
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.inference.discrepancy import Discrepancy
    from probation.inference.refit import Refit

UNKNOWN = "unknown"
"""What it is called among the names of effects."""

SIZES = np.geomspace(*EVIDENCE.unknown_range, EVIDENCE.unknown_sizes)
"""Squared sizes of an unknown effect in one record, in units of the noise's variance per wave; log-uniform."""


def log_evidence_of_unknown(
    linearised: Linearised, found: Refit, discrepancy: Discrepancy, forms: FloatArray | None = None
) -> float:
    """Log evidence of an explanation jointly with an unknown effect.

    Parameters
    ----------
    linearised : Linearised
        The explanation, its forms' errors included.
    found : Refit
        The same as it was found.
    discrepancy : Discrepancy
    forms : ndarray, shape (N, m), optional
        Ways in which its forms may be wrong.
    """
    nothing = np.zeros(len(discrepancy))
    problem = _around_the_optimum(linearised)
    count = len(discrepancy.spectrum)
    waves = problem.waves_of_residual
    left = np.array(
        [max(float(np.sum(waves[place] ** 2)) - (place.stop - place.start), 0.0) for place in discrepancy.places]
    )
    alone = np.argsort(left)[::-1][: EVIDENCE.unknown_records_tried]
    one = [_integrated(problem, discrepancy, np.eye(count)[index]) for index in alone]
    scores = [
        np.log(EVIDENCE.unknown_of_the_strain) + _along(found, discrepancy, forms, discrepancy.common),
        np.log(EVIDENCE.unknown_periodic)
        + discrepancy.log_strain_periodic_share
        + _along(found, discrepancy, forms, discrepancy.strain_periodic),
        np.log(EVIDENCE.unknown_of_the_specimen) + _along(found, discrepancy, forms, discrepancy.specimens),
        np.log(EVIDENCE.unknown_in_all) + _integrated(problem, discrepancy, np.ones(count)),
        np.log(EVIDENCE.unknown_in_one / count) + float(logsumexp(one)),
        np.log(EVIDENCE.unknown_in_each) + _in_each(problem, discrepancy, left),
    ]
    return float(logsumexp(scores)) + linearised.log_integral(nothing) - problem.log_integral(nothing)


def _around_the_optimum(problem: Linearised) -> Linearised:
    """The same with priors as broad as they are, but around the optimum."""
    # An unknown effect gains by what it describes, not by making a large effect in the same model small.
    return replace(problem, away=np.zeros_like(problem.away))


def _integrated(problem: Linearised, discrepancy: Discrepancy, pattern: FloatArray) -> float:
    """Mean over the sizes of a discrepancy of such a pattern over the records."""
    scores = problem.log_integrals(np.array([discrepancy.variances(size * pattern) for size in SIZES]))
    return float(logsumexp(scores)) - float(np.log(len(SIZES)))


def _along(fit: Refit, discrepancy: Discrepancy, forms: FloatArray | None, columns: FloatArray) -> float:
    """Mean over the sizes of a discrepancy along given columns, of independent amplitudes."""
    count = columns.shape[1]
    if count == 0:
        return -np.inf
    # What the law's own parameters, of flat priors, can follow is free; left in, it would cost digits.
    columns = without(columns, span_of(fit.jacobian[:, : fit.model.base_count]))
    together = columns if forms is None else np.hstack([forms, columns])
    jointly = _around_the_optimum(Linearised.of(fit, discrepancy, together))
    nothing = np.zeros((1, len(jointly.waves_of_residual)))
    scores = jointly.log_integrals(nothing, count, np.sqrt(SIZES))
    return float(logsumexp(scores)) - float(np.log(len(SIZES)))


def _in_each(problem: Linearised, discrepancy: Discrepancy, start: FloatArray) -> float:
    """A size of its own in each record: coordinate ascent, each paid for."""
    best = start.copy()
    score = problem.log_integral(discrepancy.variances(best))
    for _ in range(2):
        before = score
        for index in range(len(best)):
            near = SIZES[np.argsort(np.abs(np.log(SIZES / max(best[index], 1.0))))[:3]]
            tried = np.repeat(best[None, :], 1 + len(near), axis=0)
            tried[:, index] = 0.0, *near
            values = problem.log_integrals(np.array([discrepancy.variances(each) for each in tried]))
            values = np.nan_to_num(values, nan=-np.inf)
            if values.max() > score:
                best, score = tried[values.argmax()], float(values.max())
        if score - before < EVIDENCE.unknown_settled:
            break
    # A peak in the logarithm of a size is about two of the grid's steps wide.
    return float(score - len(best) * np.log(len(SIZES) / 2.0))
