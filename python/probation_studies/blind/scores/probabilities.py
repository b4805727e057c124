"""Whether probabilities mean what they say."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from scipy.stats import rankdata

from probation_studies.blind.scores.intervals import DRAWS, Rate

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from probation_studies.blind.scores.case import Case

LEAST_PROBABILITY = 1e-6
"""Of the truth, where an answer gives none: the log score stays finite."""

_BINS = 10


def log_score(cases: Sequence[Case]) -> float | None:
    """Mean of ln P(truth); 0 is best."""
    if not cases:
        return None
    return float(np.mean([np.log(max(case.probability, LEAST_PROBABILITY)) for case in cases]))


def brier_score(cases: Sequence[Case]) -> float | None:
    """Mean squared distance of the probabilities from the truth, over all explanations; 0 is best, 2 is worst."""
    if not cases:
        return None
    distances = []
    for case in cases:
        squares = sum(value**2 for value in case.answer.probability.values())
        distances.append(squares - 2.0 * case.probability + 1.0)
    return float(np.mean(distances))


def reliability(cases: Sequence[Case]) -> dict[str, object]:
    """How often the top explanation is right beside how probable it was said to be.

    Returns
    -------
    dict
        "bins" (ten equal ones; mean probability and exact rate of each that holds any, and "calibrated95", between
        which that rate is in 95 % of repeats with a calibrated solver), "ece" (expected calibration error) and
        "ece_limit95", which a calibrated solver with these probabilities stays below in 95 % of repeats.
    """
    said = np.array([min(max(case.answer.probability[case.answer.top], 0.0), 1.0) for case in cases])
    right = np.array([case.right for case in cases], dtype=bool)
    if not len(said):
        return {"bins": [], "ece": None, "ece_limit95": None}
    bins = np.minimum((said * _BINS).astype(int), _BINS - 1)
    drawn = np.random.default_rng(0).uniform(size=(DRAWS, len(said))) < said
    curve: list[dict[str, object]] = []
    for which in np.unique(bins):
        here = bins == which
        band = np.quantile(drawn[:, here].mean(axis=1), [0.025, 0.975])
        curve.append(
            {
                "probability": float(said[here].mean()),
                "right": Rate.of(right[here].tolist()).plain(),
                "calibrated95": band.tolist(),
            }
        )
    limit = float(np.quantile([_calibration_error(said, each, bins) for each in drawn], 0.95))
    return {"bins": curve, "ece": _calibration_error(said, right, bins), "ece_limit95": limit}


def _calibration_error(said: NDArray[np.float64], right: NDArray[np.bool_], bins: NDArray[np.int64]) -> float:
    off = np.bincount(bins, weights=said - right, minlength=_BINS)
    return float(np.abs(off).sum() / len(said))


def area_under_curve(positives: Sequence[float], negatives: Sequence[float]) -> float | None:
    """Probability that a positive scores above a negative, ties by halves; None without both."""
    if not positives or not negatives:
        return None
    ranks = rankdata([*positives, *negatives])[: len(positives)]
    more = ranks.sum() - len(positives) * (len(positives) + 1) / 2.0
    return float(more / (len(positives) * len(negatives)))
