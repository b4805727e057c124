"""An effect outside the catalogue: a smooth discrepancy of any size, in one record, in all alike, or in each its own.

Which of these it is nobody knows beforehand, so that each has a share of the prior, and its size is integrated over:
what is the same function of the strain in all records needs a few numbers to be told, what is another in each many.
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import logsumexp

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.diagnosis.discrepancy import Discrepancy
    from probation.diagnosis.laplace import Linearised

SIZES = 10.0 ** np.arange(0.5, 9.0, 0.5)
"""Squared sizes of an unknown effect in one record, in units of the noise's variance per wave; log-uniform."""

OF_THE_STRAIN, ALIKE, IN_ONE, IN_EACH = 0.3, 0.3, 0.3, 0.1
"""Prior shares: one function of the strain, one size in all records, in one record only, a size in each."""

RECORDS = 2
"""Records that are tried alone, those with the most left."""


def log_evidence_of_unknown(problem: Linearised, common: Linearised, discrepancy: Discrepancy) -> float:
    """Log evidence of an explanation with an unknown effect beside it.

    Parameters
    ----------
    problem : Linearised
        Of the explanation.
    common : Linearised
        The same with the discrepancy's waves over the strain as its last columns.
    discrepancy : Discrepancy
    """
    count = len(discrepancy.spectrum)
    waves = problem.waves_of_residual
    left = np.array(
        [max(float(np.sum(waves[place] ** 2)) - (place.stop - place.start), 0.0) for place in discrepancy.places]
    )
    alone = np.argsort(left)[::-1][:RECORDS]
    one = [_integrated(problem, discrepancy, np.eye(count)[index]) for index in alone]
    found = [
        np.log(OF_THE_STRAIN) + _of_the_strain(common, discrepancy.common.shape[1]),
        np.log(ALIKE) + _integrated(problem, discrepancy, np.ones(count)),
        np.log(IN_ONE / count) + float(logsumexp(one)),
        np.log(IN_EACH) + _in_each(problem, discrepancy, left),
    ]
    return float(logsumexp(found))


def _integrated(problem: Linearised, discrepancy: Discrepancy, pattern: FloatArray) -> float:
    """Mean over the sizes of a discrepancy of such a pattern over the records."""
    scores = [problem.log_integral(discrepancy.variances(size * pattern)) for size in SIZES]
    return float(logsumexp(scores)) - float(np.log(len(SIZES)))


def _of_the_strain(common: Linearised, waves: int) -> float:
    """Mean over the sizes of one function of the strain."""
    if waves == 0:
        return -np.inf
    nothing = np.zeros(len(common.waves_of_residual))
    scores = []
    for size in SIZES:
        precision = common.precision.copy()
        precision[-waves:] = 1.0 / size
        sized = replace(common, precision=precision, log_prior=common.log_prior - 0.5 * waves * float(np.log(size)))
        scores.append(sized.log_integral(nothing))
    return float(logsumexp(scores)) - float(np.log(len(SIZES)))


def _in_each(problem: Linearised, discrepancy: Discrepancy, start: FloatArray) -> float:
    """A size of its own in each record: coordinate ascent, each paid for."""
    best = start.copy()
    score = problem.log_integral(discrepancy.variances(best))
    for _ in range(2):
        before = score
        for index in range(len(best)):
            near = SIZES[np.argsort(np.abs(np.log(SIZES / max(best[index], 1.0))))[:3]]
            for size in (0.0, *near):
                tried = best.copy()
                tried[index] = size
                value = problem.log_integral(discrepancy.variances(tried))
                if value > score:
                    best, score = tried, value
        if score - before < 0.1:
            break
    # A peak in the logarithm of a size is about two of the grid's steps wide.
    return float(score - len(best) * np.log(len(SIZES) / 2.0))
