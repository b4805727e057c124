"""Is a column another measure than its heading says? Engineering stress and strain are often taken for true ones."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.inference.problem import Problem
from probation.inference.refit import refit
from probation.inference.unsolvable import UNSOLVABLE
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView
    from probation.inference.base_fit import BaseFit


def other_measure(base: BaseFit) -> tuple[str, ...]:
    """A question, where the law describes records far better with one of their columns taken for engineering's.

    No cause is refused for that: a material that is damaged may look so. Specimens count as alike.

    Parameters
    ----------
    base : BaseFit
        The law on the records, with a gap.
    """
    try:
        before = _misfit(base, base.model.views)
    except UNSOLVABLE:
        return ()
    least = (1.0 - EVIDENCE.other_measure) * before
    answer: tuple[str, ...] = ()
    for column, converted in (("stress", _true_stress), ("strain", _true_strain)):
        try:
            after = _misfit(base, [converted(view) for view in base.model.views])
        except UNSOLVABLE:
            continue
        if after < least:
            least = after
            closed = 100.0 * (1.0 - after / before)
            answer = (
                f"is the {column} engineering {column}? With it converted to true {column} the law alone, specimens "
                f"alike, closes {min(closed, 99.9):.3g} % of the squared misfit; state its measure in the heading, "
                f'such as "engineering_{column}", if so',
            )
    return answer


def _true_stress(view: RecordView) -> RecordView:
    return view.with_data(view.data * view.sampled(view.stretch))


def _true_strain(view: RecordView) -> RecordView:
    return view.driven(np.log1p(np.maximum(view.true_strain, -0.9)))


def _misfit(base: BaseFit, views: list[RecordView] | tuple[RecordView, ...]) -> float:
    """Sum of squares of what the law leaves, in units of each record's noise."""
    levels = [max(noise.sigma, 1e-300) for noise in base.whitened.noises]
    problem = Problem.white(base.model.law, views, levels)
    return float(np.sum(refit(problem, base.refit.parameters[: base.model.base_count]).residual ** 2))
