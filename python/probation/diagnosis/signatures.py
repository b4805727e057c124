"""Lines, steps and drifting parameters of the residual, in sentences (docs/diagnosis-method.md, section 3)."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.detection.lines_and_steps import find_lines, find_steps
from probation.detection.signatures import Drift, parameter_drift, usual_covariates
from probation.diagnosis.result import Signature
from probation.inference.parameter import symbol_of
from probation.settings.detection import DETECTION
from probation.wording import listed, percentage

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.diagnosis.hypothesis import Hypothesis
    from probation.inference.base_fit import BaseFit


ALONG = {
    "log_rate": "with the strain rate",
    "temperature": "with the temperature",
    "order": "with the order of the tests",
}
"""What a parameter may change with, in words."""


def signatures(base: BaseFit, best: Hypothesis) -> tuple[Signature, ...]:
    """Lines of one frequency, steps, and parameters that drift with the rate or the order of the tests.

    A gap that bends sharply looks like a step, one that is nearly periodic like a line: where the best explanation has
    nothing sharp in it, they are looked for in what it leaves.

    Parameters
    ----------
    base : BaseFit
    best : Hypothesis
    """
    entries: list[Signature] = []
    whitened, names = base.whitened, base.law.parameter_names
    left = whitened
    if all(cause.form.sharp is None for cause in best.causes):
        left = whitened.with_residual(best.refit.residual, best.refit.jacobian)
    for line in find_lines(left):
        if line.p_value < DETECTION.signature_level:
            text = f"a wave of {line.amplitude_MPa:.2g} MPa at {line.frequency_Hz:.3g} Hz in {line.record}"
            entries.append(Signature("line", line.record, line.p_value, text))
    for step in find_steps(left):
        if step.p_value < DETECTION.signature_level:
            text = (
                f"a step of {-step.size_MPa:+.2g} MPa in {step.record} at {step.time_s:.4g} s "
                f"(true strain {step.true_strain:.3g})"
            )
            entries.append(Signature("step", step.record, step.p_value, text))
    if len(whitened.records) > 2:
        for drift in parameter_drift(whitened, names, _covariates(base)):
            if drift.heterogeneity_p_value >= DETECTION.signature_level:
                continue
            reach = max(drift.change.values()) - min(drift.change.values())
            value = abs(base.parameters[names.index(drift.parameter)])
            size = (
                f"{reach:.2g}, where all records together give {value:.2g}"
                if reach >= value
                else f"{percentage(reach / value)} % of its value"
            )
            parameter = symbol_of(drift.parameter)
            text = f"{parameter}, refitted record by record, changes {changes_with(drift)}, by up to {size}"
            entries.append(Signature("parameter", None, drift.heterogeneity_p_value, text))
    return tuple(entries)


def changes_with(drift: Drift) -> str:
    """What a parameter follows beyond the noise and beyond what records differ by at random, in words."""
    followed = [
        words
        for name, words in ALONG.items()
        if drift.slope_p_value.get(name, 1.0) < DETECTION.signature_level
        and drift.scatter_p_value[name] < DETECTION.scatter_level
    ]
    return listed(followed) or "from record to record"


def _covariates(base: BaseFit) -> dict[str, Sequence[float]]:
    """The usual ones, and the mean temperature where every record has one."""
    along = usual_covariates(base.whitened)
    temperatures = [view.temperature for view in base.model.views]
    known = [float(np.mean(temperature)) for temperature in temperatures if temperature is not None]
    if len(known) == len(base.whitened.records):
        along["temperature"] = known
    return along
