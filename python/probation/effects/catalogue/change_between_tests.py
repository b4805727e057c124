"""The material changes from test to test: moisture, ageing."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.effects.record_view import RecordView

_LOSS = EffectParameter(
    "log_modulus_loss", "", -1.0, 1.5, 0.1, "moisture takes some tenths of a polyamide's modulus; ageing adds some"
)
_TIMES = EffectParameter(
    "log_time_gain",
    "",
    -4.0,
    4.0,
    0.5,
    "relaxation slows down in proportion to the age; moisture speeds it up",
)
_POWER = EffectParameter(
    name="time_exponent",
    unit="",
    lower=0.3,
    upper=3.0,
    centre=0.8,
    scale=0.5,
    log=True,
    starts=(0.5, 1.5),
    reason="1/2 is diffusion into a plate (Crank)",
)


def _steadily(view: RecordView, values: Values) -> Modification:
    """E_u exp(-a p), p from 0 in the first test to 1 in the last."""
    return _changed(view, values[0], 1.0)


def _as_a_power(view: RecordView, values: Values) -> Modification:
    """E_u exp(-a p^n), p from 0 in the first test to 1 in the last."""
    return _changed(view, values[0], values[1])


def _slower(view: RecordView, values: Values) -> Modification:
    """tau_max exp(a p^n): relaxation times grow as a power of the age, about 1 (Struik), so by its logarithm in ln."""
    return Modification(relaxation_time_factor=np.full(1, np.exp(values[0] * _place(view) ** values[1])))


def _changed(view: RecordView, loss: float, power: float) -> Modification:
    return Modification(unrelaxed_modulus_factor=np.full(1, np.exp(-loss * _place(view) ** power)))


def _place(view: RecordView) -> float:
    """0 for the first test, 1 for the last."""
    return view.index / max(view.count - 1, 1)


def _several(views: Sequence[RecordView]) -> bool:
    return len({view.specimen_id or view.id for view in views}) >= EFFECTS.fewest_in_order


EFFECT = Effect(
    name="change_between_tests",
    title="moisture or ageing between tests",
    physics=(
        "Specimens wait for their test, take up water or dry, crystallise or age: their modulus, or their relaxation "
        "times, go with the order.\n"
        "Amplitude: -ln of E_u, or ln of tau_max, of the last test over that of the first."
    ),
    source="Struik 1978, Physical Aging in Amorphous Polymers; Crank 1975, The Mathematics of Diffusion; ISO 291",
    shows_in="three specimens or more, in the order in which they were tested",
    kind="material",
    coordinate="order",
    forms=(
        Form("steadily", (_LOSS,), modification=_steadily, needs=_several),
        Form("as_a_power", (_LOSS, _POWER), modification=_as_a_power, needs=_several),
        Form("relaxation_time", (_TIMES, _POWER), modification=_slower, needs=_several, variant=True),
    ),
    odds=0.3,
)
