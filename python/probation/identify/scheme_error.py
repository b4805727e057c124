"""What the scheme's own error does to the parameters, and how many substeps make that negligible."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.identify.weighting import known_of
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.identify.covariance import Covariance
    from probation.identify.weighting import Weighted
    from probation.inference.problem import Problem
    from probation.inference.record_problem import RecordProblem
    from probation.law.modal import Law


MOST_SUBSTEPS = 16
"""Most steps of the scheme from sample to sample that a fit takes by itself, on long records."""

ENOUGH_INSTANTS = 4000
"""On short records it may take more, up to this many instants in all: they cost next to nothing."""


def scheme_error(
    problem: Problem, records: Sequence[RecordProblem], law: Law, jacobian: FloatArray, known: Covariance
) -> tuple[float, FloatArray]:
    """How far the scheme of `records` is from SA3 [MPa], and what that does to the parameters, in standard errors."""
    free = problem.free
    errors = [each.stress(law) - each.reference().stress(law) for each in records]
    weighted = problem.whitened(errors, law)
    size = np.where(law.parameters[free] != 0.0, np.abs(law.parameters[free]), 1.0)
    moved = -np.linalg.lstsq(jacobian[:, free] * size, weighted, rcond=1e-12)[0] * size
    deviation = np.sqrt(np.diag(known.matrix))
    shift = np.divide(moved, deviation, out=np.zeros_like(moved), where=deviation > 0.0)
    return max(float(np.max(np.abs(error))) for error in errors), shift


def needed_substeps(weighted: Weighted, records: Sequence[RecordProblem], at_least: int = 1) -> int:
    """Steps from sample to sample that make the error of the scheme, of order 2, negligible for every parameter.

    Best where the fit is solved by SA3: the scheme's error in the fit residual would widen the standard errors that
    it is measured in.

    Parameters
    ----------
    weighted : Weighted
        The fit.
    records : sequence of RecordProblem
        By the scheme.
    at_least : int
    """
    problem, law = weighted.problem, weighted.law
    known, jacobian = known_of(weighted)
    most = max(MOST_SUBSTEPS, ENOUGH_INSTANTS // max(len(each.record) for each in records))
    steps = at_least
    while True:  # once would do, were the steps always short enough for the order to show
        shift = scheme_error(problem, [each.with_substeps(steps) for each in records], law, jacobian, known)[1]
        worst = float(np.max(np.abs(shift), initial=0.0))
        if worst <= CERTIFICATE.negligible_scheme_shift or steps >= most:
            return steps
        steps = min(max(int(np.ceil(steps * np.sqrt(worst / CERTIFICATE.negligible_scheme_shift))), steps + 1), most)
