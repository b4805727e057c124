"""A material that ages while it is tested."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_AGE = EffectParameter(
    name="age_at_start_s",
    unit="s",
    lower=1.0,
    upper=1e7,
    centre=1000.0,
    scale=2.0,
    log=True,
    reason="minutes to days from the quench, or from the last heating, to the test",
)


def _grown(view: RecordView, values: Values) -> FloatArray:
    return np.asarray((1.0 + view.elapsed / values[1]) ** values[0])


def _times(view: RecordView, values: Values) -> Modification:
    """tau_max (1 + t / t_e)^m, t_e the age at the start of every test."""
    return Modification(relaxation_time_factor=_grown(view, values))


def _modulus(view: RecordView, values: Values) -> Modification:
    """E_u (1 + t / t_e)^m."""
    return Modification(unrelaxed_modulus_factor=_grown(view, values))


def _ages(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """A tenth of the longest record, and all of it."""
    longest = max(view.duration for view in views)
    return [(_AGE.inside(part * longest),) for part in (0.1, 1.0)]


EFFECT = Effect(
    name="ageing",
    title="ageing during the test",
    physics=(
        "A material that was quenched or heated not long ago goes on ageing while it is tested, in every test from the "
        "same age on: it relaxes ever more slowly, or stiffens.\n"
        "Amplitude: the shift rate, d ln tau_max (or d ln E_u) / d ln age."
    ),
    source="Struik 1978, Physical Aging in Amorphous Polymers and Other Materials",
    shows_in="slow tests and long dwells, against fast tests",
    kind="material",
    coordinate="log_time",
    odds=0.3,
    forms=(
        Form(
            "relaxation_time",
            (
                EffectParameter(
                    "shift_rate", "", 0.0, 1.5, 0.3, "0.7 to 1 in glassy polymers, less in semi-crystalline ones"
                ),
                _AGE,
            ),
            modification=_times,
            starts=_ages,
            variant=True,
        ),
        Form(
            "modulus",
            (EffectParameter("modulus_shift_rate", "", 0.0, 0.5, 0.05, "some per cent per decade of age"), _AGE),
            modification=_modulus,
            starts=_ages,
            variant=True,
        ),
    ),
)
