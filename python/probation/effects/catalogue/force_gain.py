"""The force, or the section, is wrong by a factor."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.visible import several

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


_REFERENCE_STRESS = 10.0
"""Nominal stress at which a cell whose characteristic bends in all tests has the excess of its amplitude [MPa]."""

_POWER = EffectParameter(
    name="power",
    unit="",
    lower=0.3,
    upper=4.0,
    centre=1.4,
    scale=0.5,
    log=True,
    starts=(1.0, 2.0),
    reason="1 for the square, 2 for the cube of the force in a characteristic",
)


def _gain(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    return (1.0 + values[0]) * stress


def _drifting(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """From nothing at the start of a record to a at its end, as 1 - e^(-t/T), T in parts of the record."""
    part = np.expm1(-view.elapsed / (values[1] * view.duration)) / np.expm1(-1.0 / values[1])
    return np.asarray((1.0 + values[0] * part) * stress)


def _bending(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """In proportion to a power of the force: nothing at rest, a at the largest one that was recorded."""
    used = np.abs(stress) / view.stretch / max(float(np.max(np.abs(view.nominal_data))), 1e-300)
    return _bent(values, used, stress)


def _characteristic(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """F (1 + a (n / 10 MPa)^b), n the nominal stress: one cell for all records, whatever their largest force."""
    return _bent(values, np.abs(stress) / view.stretch / _REFERENCE_STRESS, stress)


def _bent(values: Values, used: FloatArray, stress: FloatArray) -> FloatArray:
    return np.asarray((1.0 + values[0] * used ** values[1]) * stress)


EFFECT = Effect(
    name="force_gain",
    title="gain of the force",
    physics=(
        "The load cell's sensitivity, or the measured initial section, is wrong by a factor; or the bridge of the cell "
        "warms up, and its sensitivity drifts while the test runs, ever more slowly; or its characteristic bends.\n"
        "Amplitude: relative excess of the recorded stress, by the end of a record, or at its largest force; at 10 MPa "
        "of nominal stress, if the cell of all records bends. In all records alike a factor hides in E_u and G."
    ),
    source=(
        "ISO 7500-1; ISO 527-1 (measurement of the section); OIML R 60 (temperature and the sensitivity of a cell); "
        "ISO 376 (a cell's characteristic is a polynomial of the force, to the third degree)"
    ),
    shows_in="one record compared with others; a factor never in all of them, unless E_u or G is held",
    kind="rig",
    coordinate="force",
    forms=(
        Form(
            "factor",
            (EffectParameter("gain_error", "", -0.5, 0.5, 0.02, "class 1 cells and sections to 1 to 2 %"),),
            recorded_stress=_gain,
        ),
        Form(
            "drifting",
            (
                EffectParameter(
                    "gain_drift", "", -0.2, 0.2, 0.005, "0.1 to 1 % for a bridge that warms by 10 to 50 °C"
                ),
                EffectParameter(
                    name="time_constant_of_record",
                    unit="",
                    lower=0.02,
                    upper=10.0,
                    centre=0.5,
                    scale=1.2,
                    log=True,
                    starts=(0.15, 3.0),
                    reason="a cell warms up within minutes to an hour; with much more than the record it is steady",
                ),
            ),
            recorded_stress=_drifting,
            variant=True,
        ),
        Form(
            "bending",
            (
                EffectParameter("gain_bend", "", -0.5, 0.5, 0.02, "class 1 cells to 1 %, one that was overloaded more"),
                _POWER,
            ),
            recorded_stress=_bending,
            placements=("one",),
            variant=True,
        ),
        Form(
            "characteristic",
            (
                EffectParameter("gain_bend_at_10MPa", "", -0.5, 0.5, 0.01, "class 1 cells to 1 %"),
                _POWER,
            ),
            recorded_stress=_characteristic,
            placements=("all",),
            needs=several,
            variant=True,
        ),
    ),
)
