"""The room warms."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible_temperature import all_known, all_measured
from probation.effects.warming import HARDENING_PART, SOFTENING, warmed
from probation.law.modification import Modification

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.effects.record_view import RecordView

_REASON = "laboratories keep their temperature to 2 degrees"


def _within_record(view: RecordView, values: Values) -> Modification:
    """From nothing at the start of the record to a at its end."""
    return warmed(values[0] * view.elapsed / view.duration, *values[1:])


def _conditioned(view: RecordView, values: Values) -> Modification:
    """As e^(-t / T), T a fraction of the record: a at the start, since the specimen comes from elsewhere."""
    return warmed(values[0] * np.exp(-view.elapsed / (values[1] * view.duration)), *values[2:])


def _test_to_test(view: RecordView, values: Values) -> Modification:
    """From nothing in the first record to a in the last, in order of test."""
    return warmed(np.full(1, values[0] * view.index / max(view.count - 1, 1)), *values[1:])


def _other_temperature(view: RecordView, values: Values) -> Modification:
    """One record at another temperature than the others."""
    return warmed(np.full(1, values[0]), *values[1:])


def _not_measured(views: Sequence[RecordView]) -> bool:
    return not all_measured(views)


def _not_known(views: Sequence[RecordView]) -> bool:
    """Declared differences are no drift: `temperature_dependence` takes them as they are."""
    return not all_known(views)


EFFECT = Effect(
    name="temperature_drift",
    title="drift of the temperature",
    physics=(
        "The room, and with it the specimen, warms during a record, from test to test, or was warmer in one of them; "
        "or the specimen had not yet come to the temperature of its chamber.\n"
        "Amplitude: the rise; by how much relaxation times and G fall per degree is free within a prior. Thermal "
        "strains (1.5e-4 per degree) are left out."
    ),
    source=(
        "Na et al. 2007, J. Phys. Chem. B 111, 13206; ISO 291 (standard atmospheres); Newton 1701 (a body comes to the "
        "temperature around it by one time constant)"
    ),
    shows_in="long records, or records of different days, where their temperatures are not known",
    kind="rig",
    coordinate="time",
    forms=(
        Form(
            "within_record",
            (EffectParameter("warming_degC", "°C", -30.0, 30.0, 2.0, _REASON), SOFTENING, HARDENING_PART),
            modification=_within_record,
            needs=_not_measured,
        ),
        Form(
            "conditioned",
            (
                EffectParameter("warming_degC", "°C", -30.0, 30.0, 2.0, _REASON),
                EffectParameter(
                    name="time_constant_of_record",
                    unit="",
                    lower=0.02,
                    upper=3.0,
                    centre=0.3,
                    scale=1.0,
                    log=True,
                    starts=(0.2,),
                    reason="a specimen takes the temperature of its chamber within minutes",
                ),
                SOFTENING,
                HARDENING_PART,
            ),
            modification=_conditioned,
            needs=_not_measured,
            variant=True,
        ),
        Form(
            "test_to_test",
            (EffectParameter("warming_degC", "°C", -30.0, 30.0, 2.0, _REASON), SOFTENING, HARDENING_PART),
            modification=_test_to_test,
            needs=_not_known,
            placements=("all",),
        ),
        Form(
            "other_temperature",
            (EffectParameter("warmer_by_degC", "°C", -30.0, 30.0, 2.0, _REASON), SOFTENING, HARDENING_PART),
            modification=_other_temperature,
            needs=_not_known,
            placements=("one",),
            several=False,
        ),
    ),
)
