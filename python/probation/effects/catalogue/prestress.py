"""The specimen is under stress when the record starts."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.law.modification import InitialStress, Modification

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_AMPLITUDE = EffectParameter(
    "prestress_MPa", "MPa", -20.0, 20.0, 0.5, "clamping and straightening take some per cent of a yield stress"
)

_HELD = EffectParameter(
    name="held_over_tau_max",
    unit="",
    lower=1e-4,
    upper=3.0,
    centre=0.1,
    scale=1.5,
    log=True,
    starts=(0.02, 0.3),
    reason="seconds to minutes between clamping and starting",
)
_PULLED = replace(_HELD, name="pulled_over_tau_max", reason="seconds to minutes from slack to the zero of the readings")
_MODULUS = EffectParameter(
    name="preload_modulus_MPa",
    unit="MPa",
    lower=1.0,
    upper=1e5,
    centre=1000.0,
    scale=1.5,
    log=True,
    reason="what is left of the stress, over the strain that made it: a part of a polymer's modulus",
)


def _fresh(view: RecordView, values: Values) -> Modification:
    """As after a sudden stretch: every mode carries its weight's part."""
    return Modification(initial_stress=InitialStress(values[0]))


def _held(view: RecordView, values: Values) -> Modification:
    """As after a dwell at that stretch: the fast modes have relaxed."""
    return Modification(initial_stress=InitialStress(values[0], values[1]))


def _pulled(view: RecordView, values: Values) -> Modification:
    """As in the midst of a pull at one rate, for that long so far."""
    return Modification(initial_stress=InitialStress(values[0], pulled=values[1]))


def _before_zero(view: RecordView, values: Values) -> FloatArray:
    """The strain was zeroed under that stress: the specimen had been stretched by s_0 / E_0."""
    return np.asarray(view.true_strain + values[0] / values[2])


_UNDER_LOAD = Form(
    "zeroed_under_load",
    (_AMPLITUDE, _PULLED, _MODULUS),
    modification=_pulled,
    driving_strain=_before_zero,
    variant=True,
)


EFFECT = Effect(
    name="prestress",
    title="prestress",
    physics=(
        "Clamping or straightening loads the specimen before the record starts; that stress then relaxes. The strain "
        "may have been zeroed only then.\n"
        "Amplitude: stress at the first sample: fresh, held for some time, or in the midst of a pull."
    ),
    source="ISO 527-1, section 9.4 (prestresses)",
    shows_in="the start of a record, for about the longest relaxation time",
    kind="rig",
    coordinate="log_time",
    forms=(
        Form("fresh", (_AMPLITUDE,), modification=_fresh),
        Form("held", (_AMPLITUDE, _HELD), modification=_held),
        _UNDER_LOAD,
        _UNDER_LOAD.measured_section(),
    ),
)
