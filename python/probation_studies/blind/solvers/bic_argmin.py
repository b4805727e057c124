"""The single effect, or none, of the least Bayesian information criterion (Schwarz 1978)."""

from __future__ import annotations

from pathlib import Path

import numpy as np

from probation.errors import ConvergenceError, InputError
from probation.inference.candidate import Candidate, cause_key
from probation.inference.refit import refit
from probation_studies.blind.solvers.survey import Scored, Survey, answer, survey

REFITTED = 12
"""Forms and places that are refitted, those whose linearised gain is largest."""

STEPS = 12


def bic_argmin(folder: Path) -> dict[str, object]:
    """Weigh refits by exp(-BIC / 2), BIC = chi^2 + p ln N of p parameters more than the base law's; no priors count.

    Raises
    ------
    InputError
        If the campaign cannot be read.
    """
    found = survey(folder)
    base = found.base
    price = 0.5 * float(np.log(len(base.whitened)))
    scored: list[Scored] = [("", -0.5 * base.refit.chi_square, None)]
    for candidate in _candidates(found):
        problem = base.problem.with_causes([candidate.cause])
        try:
            fitted = refit(problem, np.concatenate([base.parameters, candidate.values]), most_steps=STEPS)
        except (ConvergenceError, InputError):
            continue
        log_weight = -0.5 * fitted.chi_square - price * len(candidate.values)
        scored.append((candidate.cause.effect.name, log_weight, candidate.cause.records))
    return answer(found, scored)


def _candidates(found: Survey) -> list[Candidate]:
    """The best start of every form and place, the best of them."""
    whitened = found.base.whitened
    best: dict[object, Candidate] = {}
    for each in found.columns.candidates(whitened.residual, whitened.span):
        best.setdefault(cause_key(each.cause), each)
    return list(best.values())[:REFITTED]
