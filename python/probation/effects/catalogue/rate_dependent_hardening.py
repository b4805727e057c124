"""G follows the strain rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.rate_onset import ONSET_RATE, log_rate_from
from probation.law.modification import Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
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


def _from_a_rate(view: RecordView, values: Values) -> Modification:
    """G ((1 + r / (b r_ref)) / (1 + 1 / b))^a: nothing changes far below the rate b r_ref."""
    return Modification(hardening_factor=np.exp(values[0] * log_rate_from(view, values[1])))


def _path(view: RecordView, values: Values) -> Modification:
    """G as the network was built: the mean of ln(r / r_ref) over the strain path so far. A dwell changes nothing."""
    return Modification(hardening_factor=np.exp(values[0] * _over_path(view, view.log_rate)))


def _path_from_a_rate(view: RecordView, values: Values) -> Modification:
    """The same mean of ln((1 + r / (b r_ref)) / (1 + 1 / b))."""
    return Modification(hardening_factor=np.exp(values[0] * _over_path(view, log_rate_from(view, values[1]))))


def _over_path(view: RecordView, values: FloatArray) -> FloatArray:
    """Mean over the strain path so far, shape (n,)."""
    way = np.append(0.0, np.abs(np.diff(view.true_strain)))
    travelled = np.cumsum(way)
    mean = np.full(len(view), values[0])
    np.divide(np.cumsum(way * values), travelled, out=mean, where=travelled > 0.0)
    return mean


EFFECT = Effect(
    name="rate_dependent_hardening",
    title="rate-dependent hardening",
    physics=(
        "The network is stiffer the faster it is stretched: fewer of its junctions slip.\n"
        "Amplitude: d ln G / d ln rate, the rate being that of the instant or of the path so far; far above an onset."
    ),
    source=(
        "André et al., section 4; Wendlandt, Tervoort & Suter 2005, Polymer 46, 11786; Johnson & Cook 1983 (with the "
        "logarithm of the rate above an onset)"
    ),
    shows_in="records at different rates reaching large strains",
    kind="material",
    coordinate="strain_rate",
    forms=(
        Form("instant", (_EXPONENT,), modification=_instant),
        Form("path", (_EXPONENT,), modification=_path),
        Form("from_a_rate", (_EXPONENT, ONSET_RATE), modification=_from_a_rate, variant=True),
        Form("path_from_a_rate", (_EXPONENT, ONSET_RATE), modification=_path_from_a_rate, variant=True),
    ),
)
