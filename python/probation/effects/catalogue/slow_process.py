"""A relaxation slower than the spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_TIME = EffectParameter(
    name="slow_time_s",
    unit="s",
    lower=1.0,
    upper=1e6,
    centre=1000.0,
    scale=2.0,
    log=True,
    reason="beyond tau_max, minutes to days",
)


def _slow_mode(view: RecordView, values: Values) -> Modification:
    """A Maxwell element in parallel to the spectrum, whose time no rate shifts."""
    return Modification(extra_modulus=(values[0],), extra_relaxation_time=(values[1],))


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Relaxation times of a tenth of the longest record and of all of it [s]."""
    longest = max(view.duration for view in views)
    times = np.clip(np.array([0.1, 1.0]) * longest, _TIME.lower, _TIME.upper)
    return [(float(time),) for time in times]


EFFECT = Effect(
    name="slow_process",
    title="a slow process",
    physics=(
        "One more relaxation, slower than the spectrum and not shifted by the rate (crystals sliding, say).\n"
        "Amplitude: modulus of that Maxwell element."
    ),
    source="Na et al. 2007, J. Phys. Chem. B 111, 13206; Boyd 1985, Polymer 26, 1123",
    shows_in="slow records and long dwells, against fast records",
    kind="material",
    coordinate="log_time",
    forms=(
        Form(
            "maxwell",
            (
                EffectParameter(
                    "slow_modulus_MPa", "MPa", 0.0, 1000.0, 20.0, "adds some MPa at a strain of some tenths"
                ),
                _TIME,
            ),
            modification=_slow_mode,
            starts=_starts,
        ),
    ),
)
