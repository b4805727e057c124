"""The specimen slips in its grips."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import running_integral
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.instants import INSTANT, likely_instants, passed

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.effect import NeedsHook, StartsHook
    from probation.effects.record_view import RecordView

_DURATIONS = (0.004, 0.016)
"""Durations of a slip over that of its record [-] from which searches begin: half a usual one, and two of them."""

_PULL = EffectParameter(
    name="holding_stress_MPa",
    unit="MPa",
    lower=0.01,
    upper=200.0,
    centre=10.0,
    scale=1.5,
    log=True,
    reason="friction holds up to about the stress for which grips are tightened",
)
_FADING = (0.03, 0.1, 0.3)
"""Time constants of creep in the grips over the duration of the record [-] from which searches begin, by threes."""

_SLIP = EffectParameter("slip_strain", "", -0.2, 0.2, 0.005, "a slip of a tenth of a millimetre over a gauge of 20 mm")
_PARAMETERS = (
    _SLIP,
    INSTANT,
    EffectParameter(
        name="duration_of_record",
        unit="",
        lower=0.0,
        upper=0.04,
        centre=0.0,
        scale=0.008,
        starts=_DURATIONS,
        reason="jaws let go at once, but the channels follow within some samples",
    ),
)


def _slip(view: RecordView, values: Values) -> FloatArray:
    """Around the instant (a fraction of the record) the specimen loses a; within its duration, a sample at least."""
    return view.true_strain - values[0] * passed(view, values[1], values[2])


def _creeping(view: RecordView, values: Values) -> FloatArray:
    """From an instant on the specimen creeps out of its grips, in the end ever slower, and has lost a then.

    Of what is still to be lost after a time t, exp(-(t / t_c)^b) is left (Williams and Watts 1970; b above 1: it
    begins slowly).
    """
    since = np.maximum(view.elapsed - values[1] * view.duration, 0.0)
    return view.true_strain + values[0] * np.expm1(-((since / (values[2] * view.duration)) ** values[3]))


def _progressive(view: RecordView, values: Values) -> FloatArray:
    """Beyond a pull n_0 the jaws give way by a per further MPa, for good; n the largest nominal stress so far."""
    pull = np.maximum.accumulate(view.smooth_nominal_data)
    return view.true_strain - values[0] * np.maximum(pull - values[1], 0.0)


def _slips(view: RecordView, values: Values) -> FloatArray:
    """With every sudden fall of the force the specimen loses a per MPa of it."""
    return np.asarray(view.true_strain - values[0] * view.sudden_falls.total)


def _slips_again(views: Sequence[RecordView]) -> bool:
    """One fall has forms of its own."""
    return any(view.sudden_falls.times > 1 for view in views)


def _knives(view: RecordView, values: Values) -> FloatArray:
    """The knives of an extensometer slip: the specimen saw all but a part a of every sudden jump of the strain."""
    return np.asarray(view.true_strain - values[0] * view.sudden_jumps.total)


def _knives_slip(views: Sequence[RecordView]) -> bool:
    return any(view.sudden_jumps.times > 0 for view in views)


def _once_where(happens: NeedsHook) -> StartsHook:
    """A search begins where it happens, and there is nothing to choose."""
    return lambda views, _residuals: [()] if happens(views) else []


def _giving(view: RecordView, values: Values) -> FloatArray:
    """It creeps out at a rate in proportion to a power of the pull, and has lost a when the record ends (Norton)."""
    pull = np.maximum(view.smooth_nominal_data, 0.0)
    rate = (pull / max(float(np.max(pull)), 1e-300)) ** values[1]
    lost = running_integral(rate, view.time)
    return np.asarray(view.true_strain - values[0] * lost / max(float(lost[-1]), 1e-300))


def _pulls(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """A tenth, three and six tenths of the largest nominal stress [MPa]: more holds nearly all along the record."""
    largest = max(float(np.max(view.data / view.sampled(view.stretch))) for view in views)
    return [(_PULL.inside(part * largest),) for part in (0.1, 0.3, 0.6)]


def _starts(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    return [(instant, duration) for instant in likely_instants(views, residuals) for duration in _DURATIONS]


_SEVERAL = Form(
    "several",
    (EffectParameter("slip_per_MPa", "1/MPa", 0.0, 0.2, 1e-3, "what falls by 1 MPa has lost that over E_u"),),
    driving_strain=_slips,
    starts=_once_where(_slips_again),
    placements=("one",),
    needs=_slips_again,
    variant=True,
)

_CREEPING_WITH_PULL = Form(
    "creeping_with_pull",
    (
        _SLIP,
        EffectParameter(
            name="power_of_pull",
            unit="",
            lower=0.3,
            upper=15.0,
            centre=3.0,
            scale=0.7,
            log=True,
            starts=(1.5, 5.0),
            reason="from a soft layer of the specimen, 1, to one that flows; nearly a threshold has 10",
        ),
    ),
    driving_strain=_giving,
    placements=("one",),
    variant=True,
)

_KNIVES = Form(
    "knives",
    (EffectParameter("part_of_jumps", "", 0.0, 1.5, 1.0, "all of a jump, where the material cannot follow it"),),
    driving_strain=_knives,
    starts=_once_where(_knives_slip),
    placements=("one",),
    needs=_knives_slip,
    variant=True,
)

EFFECT = Effect(
    name="grip_slip",
    title="slip in the grips",
    physics=(
        "The specimen slips in its grips at some instant, or whenever the force falls suddenly, and its strain jumps "
        "back, the recorded one does not; or it creeps out of them, from some instant on or by the pull; or it gives "
        "way little by little beyond the pull that friction holds. Or the knives of an extensometer slip on it.\n"
        "Amplitude: recorded strain that is lost (per stress beyond what holds, or that falls), or the part of what "
        "jumps. The true stress was made of it, or measured apart."
    ),
    source=(
        "ISO 527-1, section 5.1.3 (grips); Coulomb 1785 (friction holds up to a pull); Heslot et al. 1994, Phys. "
        "Rev. E 49, 4973 (dry contacts creep); Williams & Watts 1970 (over several decades); Norton 1929 (by the pull)"
    ),
    shows_in=(
        "one record, from one instant on: the stress drops and recovers, or, where the extensometer slips, the "
        "recorded strain jumps; or all records at high stress"
    ),
    kind="rig",
    forms=(
        Form("recorded_section", _PARAMETERS, driving_strain=_slip, starts=_starts, placements=("one",), sharp="step"),
        Form(
            "measured_section",
            _PARAMETERS,
            driving_strain=_slip,
            starts=_starts,
            converts=False,
            placements=("one",),
            sharp="step",
        ),
        _SEVERAL,
        _SEVERAL.measured_section(),
        _KNIVES,
        _KNIVES.measured_section(),
        Form(
            "creeping",
            (
                _SLIP,
                replace(INSTANT, starts=tuple(np.linspace(0.1, 0.9, 9).tolist())),
                EffectParameter(
                    name="time_constant_of_record",
                    unit="",
                    lower=0.005,
                    upper=1.0,
                    centre=0.1,
                    scale=1.0,
                    log=True,
                    starts=_FADING,
                    reason="dry contacts under load creep at a rate that falls, for seconds to minutes",
                ),
                EffectParameter(
                    name="stretching_exponent",
                    unit="",
                    lower=0.3,
                    upper=2.0,
                    centre=1.0,
                    scale=0.4,
                    log=True,
                    reason="contacts that age creep over more decades than one time constant has; others begin slowly",
                ),
            ),
            driving_strain=_creeping,
            placements=("one",),
            variant=True,
        ),
        _CREEPING_WITH_PULL,
        Form(
            "progressive",
            (
                EffectParameter("slip_per_MPa", "1/MPa", 0.0, 0.2, 1e-3, "some tenths of a per cent within some MPa"),
                _PULL,
            ),
            driving_strain=_progressive,
            starts=_pulls,
            variant=True,
        ),
    ),
)
