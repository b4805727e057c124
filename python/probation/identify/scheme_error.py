"""What the scheme's own error does to the parameters, and how many substeps make that negligible."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.weighting import known_of
from probation.law.refinement import fewest_substeps
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.identify.covariance import Covariance
    from probation.identify.weighting import Weighted
    from probation.inference.problem import Problem


ENOUGH_INSTANTS = 4000
"""On short records it may take more, up to this many instants in all: they cost next to nothing."""


def most_substeps(lengths: Iterable[int]) -> int:
    """Steps from sample to sample that are tried at most, on records of so many samples."""
    return max(CERTIFICATE.most_substeps, ENOUGH_INSTANTS // max(lengths))


def scheme_error(
    problem: Problem, views: Sequence[RecordView], parameters: FloatArray, jacobian: FloatArray, known: Covariance
) -> tuple[float, FloatArray]:
    """How far the scheme of `views` is from SA3 [MPa], and what that does to the parameters, in standard errors."""
    own, reference = (
        problem.with_views(chosen).model.residual(parameters)
        for chosen in (views, [view.with_scheme("sa3") for view in views])
    )
    weighted = problem.whitener_at(parameters).residual(own - reference)
    size = np.where(parameters != 0.0, np.abs(parameters), 1.0)
    moved = -np.linalg.lstsq(jacobian * size, weighted, rcond=1e-12)[0] * size
    deviation = np.sqrt(np.diag(known.matrix))
    shift = np.divide(moved, deviation, out=np.zeros_like(moved), where=deviation > 0.0)
    return float(np.max(np.abs(own - reference))), shift


def needed_substeps(weighted: Weighted, views: Sequence[RecordView], at_least: int = 1) -> int:
    """Steps from sample to sample that make the error of the scheme, of order 2, negligible for every parameter.

    Best where the fit is solved by SA3: the scheme's error in the fit residual would widen the standard errors that
    it is measured in.

    Parameters
    ----------
    weighted : Weighted
        The fit.
    views : sequence of RecordView
        By the scheme.
    """
    problem, parameters = weighted.problem, weighted.parameters
    known, jacobian = known_of(weighted)

    def largest_shift(steps: int) -> float:
        shift = scheme_error(problem, [view.with_substeps(steps) for view in views], parameters, jacobian, known)[1]
        return float(np.max(np.abs(shift), initial=0.0))

    return fewest_substeps(largest_shift, CERTIFICATE.negligible_scheme_shift, at_least, most_substeps(problem.lengths))
