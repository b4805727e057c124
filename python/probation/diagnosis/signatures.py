"""Sharp or drifting features of the residual, in sentences, gap-method section 3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.diagnosis.result import Signature
from probation.gap.sharp import find_lines, find_steps
from probation.gap.signatures import parameter_drift

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.gap.whitening import Whitened

LEVEL = 1e-3
"""p-value, over all records, below which a feature is told."""


def signatures(whitened: Whitened, names: Sequence[str]) -> tuple[Signature, ...]:
    """Lines of one frequency, steps, and parameters that drift with the rate or the order of the tests.

    Parameters
    ----------
    whitened : Whitened
        At the base fit.
    names : sequence of str
        Of the base parameters.
    """
    found: list[Signature] = []
    for line in find_lines(whitened):
        if line.p_value < LEVEL:
            text = f"a wave of {line.amplitude_MPa:.2g} MPa at {line.frequency_Hz:.3g} Hz in {line.record}"
            found.append(Signature("line", line.record, line.p_value, text))
    for step in find_steps(whitened, size=500):
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
