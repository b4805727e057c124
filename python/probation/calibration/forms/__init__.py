"""Forms of companion relation that can be calibrated; a new one is one file here and one line in `FORMS`.

One that campaigns can name needs its class in `probation.law.companion`, too.
"""

from __future__ import annotations

from probation.calibration.forms import constant, constant_weissenberg, exponential, power, table, weissenberg
from probation.calibration.forms.form import Form

FORMS: dict[str, Form] = {
    form.name: form
    for form in (
        weissenberg.FORM,
        power.FORM,
        exponential.FORM,
        table.FORM,
        constant_weissenberg.FORM,
        constant.FORM,
    )
}
"""In order of preference where the data cannot choose."""

CHOOSABLE = tuple(form.name for form in FORMS.values() if not form.reference)
"""Forms among which the data choose."""

NAMEABLE = (*CHOOSABLE, "table")
"""Forms that a campaign can name."""

__all__ = ["CHOOSABLE", "FORMS", "NAMEABLE", "Form"]
