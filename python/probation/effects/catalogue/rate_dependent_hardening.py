"""G follows the strain rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation.effects.record_view import RecordView

_EXPONENT = EffectParameter(
    name="hardening_rate_exponent",
    unit="",
    lower=-1.0,
    upper=1.0,
    scale=0.05,
    reason="G of polyethylene and glassy polymers grows by about 10 % per decade of rate (0.04)",
)


def _instant(view: RecordView, values: Values) -> Modification:
    """G (r / r_ref)^a with the rate of the instant."""
    return Modification(hardening_factor=np.exp(values[0] * view.log_rate))


def _path(view: RecordView, values: Values) -> Modification:
    """G as the network was built: the mean of ln(r / r_ref) over the strain path so far. A dwell changes nothing."""
    way = np.append(0.0, np.abs(np.diff(view.true_strain)))
    travelled = np.cumsum(way)
    weighted = np.cumsum(way * view.log_rate)
    mean = np.divide(weighted, travelled, out=np.full(len(view), view.log_rate[0]), where=travelled > 0.0)
    return Modification(hardening_factor=np.exp(values[0] * mean))


EFFECT = Effect(
    name="rate_dependent_hardening",
    title="rate-dependent hardening",
    physics=(
        "The network is stiffer the faster it is stretched: fewer of its junctions slip.\n"
        "Amplitude: d ln G / d ln rate, the rate being that of the instant or of the path so far."
    ),
    source="André et al., section 4; Wendlandt, Tervoort & Suter 2005, Polymer 46, 11786",
    shows_in="records at different rates reaching large strains",
    kind="material",
    coordinate="strain_rate",
    forms=(
        Form("instant", (_EXPONENT,), modification=_instant),
        Form("path", (_EXPONENT,), modification=_path),
    ),
)
