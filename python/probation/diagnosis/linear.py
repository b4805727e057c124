"""Hypotheses without refits: where no gap is seen, the linearised model says all there is to say."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import logsumexp

from probation.diagnosis.hypothesis import Hypothesis
from probation.inference.candidate import Key, cause_key
from probation.inference.evidence import evidence
from probation.inference.refit import Refit, refit
from probation.inference.unsolvable import UNSOLVABLE
from probation.noise.span import without
from probation.settings.search import SEARCH

if TYPE_CHECKING:
    from probation.diagnosis.skipped import Skipping
    from probation.inference.base_fit import BaseFit
    from probation.inference.candidate import WhitenedColumns


def linear_hypotheses(base: BaseFit, columns: WhitenedColumns, skipping: Skipping) -> list[Hypothesis]:
    """The base law and every cause at its best start, in linearised form.

    Parameters
    ----------
    base : BaseFit
    columns : WhitenedColumns
        Of the screen at the base fit.
    skipping : Skipping
        What is left out.
    """
    discrepancy = base.discrepancy
    hypotheses = [Hypothesis(base.refit, evidence(base.refit, base.refit, discrepancy))]
    span = base.whitened.span
    left = without(base.refit.residual, span)
    grouped: dict[Key, list[tuple[float, int]]] = {}
    for index, column in enumerate(columns.columns):
        slope = columns.matrix[:, index]
        seen = without(slope, span)
        scale = column.cause.form.amplitude.scale
        gain = float(seen @ left) ** 2 / max(float(seen @ seen) + scale**-2.0, 1e-300)
        grouped.setdefault(cause_key(column.cause), []).append((gain, index))
    tried: dict[str, int] = {}
    for key, entries in sorted(grouped.items(), key=lambda item: -max(item[1])[0]):
        entries.sort(reverse=True)
        chosen = [_at_zero(base, columns, index) for _, index in entries]
        if _sharp(chosen[0]):
            # A start that was read off the residual: only a refit says how narrow the peak is.
            tried[key[0]] = tried.get(key[0], 0) + 1
            if tried[key[0]] > SEARCH.sharp_places:
                continue
            column = columns.columns[entries[0][1]]
            start = chosen[0].parameters.copy()
            start[base.model.base_count] = SEARCH.sharp_start * column.cause.form.amplitude.scale
            try:
                chosen = [refit(chosen[0].problem, start, most_steps=SEARCH.sharp_steps)]
            except UNSOLVABLE as error:
                skipping.hypothesis([column.cause], error)
                continue
        judged = [evidence(fit, base.refit, discrepancy, unknown=False) for fit in chosen]
        together = float(logsumexp([start_evidence.log_evidence for start_evidence in judged])) - np.log(len(judged))
        hypotheses.append(Hypothesis(chosen[0], replace(judged[0], log_evidence=together)))
    return hypotheses


def _at_zero(base: BaseFit, columns: WhitenedColumns, index: int) -> Refit:
    """The model with a cause of amplitude 0, from which the integral over the amplitude starts."""
    column = columns.columns[index]
    problem = base.problem.with_causes([column.cause])
    model = problem.model
    parameters = model.parameters(base.parameters, (0.0, *column.values[1:]))
    jacobian = np.zeros((len(base.whitened), len(parameters)))
    jacobian[:, : model.base_count] = base.refit.jacobian
    jacobian[:, model.base_count] = columns.matrix[:, index]
    return Refit(problem, parameters, base.refit.residual, jacobian)


def _sharp(fit: Refit) -> bool:
    """Whether a nonlinear parameter may lie anywhere, so that the data choose it: a frequency, an instant."""
    return any(not np.isfinite(parameter.scale) for parameter in fit.model.effect_parameters[1:])
