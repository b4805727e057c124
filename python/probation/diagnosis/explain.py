"""From hypotheses to the entries of an answer."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.detection.where import Located, contribution_regions
from probation.diagnosis.headline import title
from probation.diagnosis.result import BaseParameter, CauseParameter, Explanation
from probation.inference.parameter import status_of
from probation.settings.evidence import EVIDENCE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation.diagnosis.hypothesis import Hypothesis
    from probation.diagnosis.probabilities import Weighed
    from probation.diagnosis.result import Checks
    from probation.inference.base_fit import BaseFit


def explanations_of(weighed: Sequence[Weighed], checks: Mapping[tuple[str, ...], Checks]) -> tuple[Explanation, ...]:
    """Entries of the answer, in the order of `weighed`, with the checks of those that were checked."""
    entries = []
    for explanation in weighed:
        causes = sorted(explanation.hypothesis.causes, key=lambda cause: cause.effect.name)
        entries.append(
            Explanation(
                effects=explanation.effects,
                titles=tuple(title(name) for name in explanation.effects),
                forms=tuple(cause.form.name for cause in causes),
                records=explanation.hypothesis.records,
                probability=explanation.probability,
                parameters=cause_parameters(explanation.hypothesis),
                checks=checks.get(explanation.effects),
                log_evidence=explanation.log_evidence,
            )
        )
    return tuple(entries)


def cause_parameters(hypothesis: Hypothesis) -> tuple[CauseParameter, ...]:
    """What is known of the causes' parameters, in the order of their effects' names."""
    refit = hypothesis.refit
    slopes = refit.coordinates.slopes(refit.parameters)
    deviation = np.sqrt(np.maximum(np.diag(hypothesis.evidence.covariance), 0.0)) * slopes
    low, high = refit.at_bound
    result, at = [], refit.model.base_count
    everywhere = tuple(view.id for view in refit.model.views)
    for cause in hypothesis.causes:
        for parameter in cause.form.parameters:
            scale = parameter.scale * (abs(refit.parameters[at]) if parameter.log else 1.0)
            known = 0.0 < deviation[at] < EVIDENCE.uninformed * scale
            result.append(
                CauseParameter(
                    effect=cause.effect.name,
                    name=parameter.name,
                    unit=parameter.unit,
                    records=cause.records or everywhere,
                    value=float(refit.parameters[at]),
                    se=float(deviation[at]) if known else None,
                    bound="lower" if low[at] else "upper" if high[at] else None,
                )
            )
            at += 1
    return tuple(sorted(result, key=lambda parameter: parameter.effect))


def base_parameters(base: BaseFit) -> tuple[BaseParameter, ...]:
    """The base law's parameters with their standard errors by noise, all of its drift included.

    Where the specimens' scatter is known from replicates, or stated, they are those of the material's mean; where it is
    assumed, of the specimens that were tested. A parameter at its bound has none.
    """
    refit = base.refit
    covariance = base.covariance if base.scatter.known else base.covariance_of_tested
    deviation = np.sqrt(np.maximum(np.diag(covariance), 0.0))
    result = []
    ended = np.any(refit.at_bound, axis=0)
    for name, value, error, stopped in zip(base.law.parameter_names, refit.parameters, deviation, ended, strict=True):
        if stopped:
            result.append(BaseParameter(name, float(value), None, "not_identifiable"))
            continue
        relative = float(error) / max(abs(float(value)), 1e-300)
        result.append(BaseParameter(name, float(value), float(error), status_of(relative)))
    return tuple(result)


def regions_of(hypothesis: Hypothesis, base: BaseFit, p_value: float) -> tuple[Located, ...]:
    """Where the causes' own contribution is certain (docs/diagnosis-method.md, section 3)."""
    refit, model = hypothesis.refit, hypothesis.refit.model
    first = model.base_count
    absent = refit.parameters.copy()
    absent[list(model.amplitudes)] = 0.0
    contribution = model.residual(refit.parameters) - model.residual(absent)
    slopes = model.jacobian(refit.parameters)[:, first:] * refit.coordinates.slopes(refit.parameters)[first:]
    rows = [part for _, part in model.parts]
    return contribution_regions(
        base.whitened.records,
        [contribution[part] for part in rows],
        [slopes[part] for part in rows],
        hypothesis.evidence.covariance[first:, first:],
        p_value,
    )
