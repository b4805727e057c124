"""Sharp or drifting features of the residual, in sentences, gap-method section 3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.detection.sharp import find_lines, find_steps
from probation.detection.signatures import parameter_drift
from probation.diagnosis.result import Signature

if TYPE_CHECKING:
    from probation.diagnosis.base_fit import BaseFit
    from probation.diagnosis.hypothesis import Hypothesis

LEVEL = 1e-3
"""p-value, over all records, below which a feature is told."""


def signatures(base: BaseFit, best: Hypothesis) -> tuple[Signature, ...]:
    """Lines of one frequency, steps, and parameters that drift with the rate or the order of the tests.

    A gap that bends sharply looks like a step, one that is nearly periodic like a line: where the best explanation has
    nothing sharp in it, they are looked for in what it leaves.

    Parameters
    ----------
    base : BaseFit
    best : Hypothesis
    """
    found: list[Signature] = []
    whitened, names = base.whitened, base.law.parameter_names
    left = whitened
    if all(cause.form.sharp is None for cause in best.causes):
        left = whitened.beside(best.refit.residual, best.refit.jacobian)
    for line in find_lines(left):
        if line.p_value < LEVEL:
            text = f"a wave of {line.amplitude_MPa:.2g} MPa at {line.frequency_Hz:.3g} Hz in {line.record}"
            found.append(Signature("line", line.record, line.p_value, text))
    for step in find_steps(left, size=500):
        if step.p_value < LEVEL:
            text = (
                f"a step of {-step.size_MPa:+.2g} MPa in {step.record} at {step.time_s:.4g} s "
                f"(true strain {step.true_strain:.3g})"
            )
            found.append(Signature("step", step.record, step.p_value, text))
    if len(whitened.records) > 2:
        for drift in parameter_drift(whitened, names):
            if drift.heterogeneity_p_value >= LEVEL:
                continue
            slopes = {name: p for name, p in drift.slope_p_value.items() if p < LEVEL}
            along = "from record to record"
            if slopes:
                covariate = min(slopes, key=lambda name: slopes[name])
                along = {"log_rate": "with the strain rate", "order": "with the order of the tests"}[covariate]
            low, high = min(drift.change.values()), max(drift.change.values())
            text = f"{drift.parameter}, refitted record by record, changes {along}, by {low:+.3g} to {high:+.3g}"
            found.append(Signature("parameter", None, drift.heterogeneity_p_value, text))
    return tuple(found)
