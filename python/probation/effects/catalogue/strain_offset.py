"""Something is recorded as strain that the specimen does not see: slack, a toe, a wrong zero."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_PULL = EffectParameter(
    name="straightening_stress_MPa",
    unit="MPa",
    lower=1e-3,
    upper=100.0,
    centre=1.0,
    scale=2.0,
    log=True,
    reason="the critical stress of the strip as a column, pi^2 E h^2 / 12 L^2: 2 MPa for 4 mm in 100 mm",
)

_SEAT = replace(_PULL, name="seating_stress_MPa", reason="joints are tight at some per cent of the largest force")

_TIME = EffectParameter(
    name="settling_time_s",
    unit="s",
    lower=0.1,
    upper=1e5,
    centre=300.0,
    scale=1.5,
    log=True,
    reason="cameras and clips warm up within minutes to hours",
)

LEAST_STRETCH = 0.1
"""Of a specimen, where more travel than there was is taken off."""


def _slack(view: RecordView, values: Values) -> FloatArray:
    """Slack is taken up first: the specimen sees nothing until the elongation exceeds the first reading by a."""
    return behind_slack(view.true_strain, values[0], float(np.expm1(view.recorded_strain[0])))


def behind_slack(true_strain: FloatArray, slack: float, begin: float) -> FloatArray:
    """True strain (n,) of what sees no elongation beyond `begin` until the slack is taken up."""
    elongation = np.expm1(true_strain)
    return np.asarray(np.log1p(np.maximum(elongation - slack, np.minimum(elongation, begin))))


def _toe(view: RecordView, values: Values) -> FloatArray:
    """Slack that is taken up gradually: the elongation u misses a tanh(u / u_t), and never falls."""
    elongation, reach = np.expm1(view.true_strain), max(values[1], values[0])
    return np.asarray(np.log1p(elongation - values[0] * np.tanh(np.maximum(elongation, 0.0) / reach)))


def _shift(view: RecordView, values: Values) -> FloatArray:
    """The zero of the strain is wrong: the specimen, relaxed at the start, saw a less than was recorded."""
    return view.true_strain - values[0]


def _settling(view: RecordView, values: Values) -> FloatArray:
    """The zero of the strain creeps while a test runs: by a (1 - e^(-t/T))."""
    return view.true_strain + values[0] * np.expm1(-view.elapsed / values[1])


def _straightening(view: RecordView, values: Values) -> FloatArray:
    """A bent strip straightens: a n / (n + n_c), n the nominal stress, is recorded besides the specimen's strain."""
    pull = np.maximum(view.smooth_nominal_data, 0.0)
    return np.asarray(view.true_strain - values[0] * pull / (pull + values[1]))


def _seating(view: RecordView, values: Values) -> FloatArray:
    """Joints of the load train, or jaws, seat themselves for good, and the crosshead travels besides, by
    a (1 - e^(-n / n_c)) gauge lengths, n the largest nominal stress so far: elongations differ by that.
    """
    pull = np.maximum.accumulate(np.maximum(view.smooth_nominal_data, 0.0))
    stretch = np.exp(view.true_strain) + values[0] * np.expm1(-pull / values[1])
    return true_strain_of(stretch)


def true_strain_of(stretch: FloatArray) -> FloatArray:
    """Logarithm of a stretch, of `LEAST_STRETCH` at least."""
    return np.asarray(np.log(np.maximum(stretch, LEAST_STRETCH)))


def _pulls(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Parts of the largest nominal stress [MPa]: a strip is straight long before it yields."""
    largest = max(float(np.max(view.data / view.sampled(view.stretch))) for view in views)
    return [(_PULL.inside(part * largest),) for part in EFFECTS.take_up_starts]


def _durations(views: Sequence[RecordView], residuals: Sequence[FloatArray] | None) -> list[tuple[float, ...]]:
    """Time constants [s]: a tenth of the shortest record, half the longest."""
    durations = [view.duration for view in views]
    return [(_TIME.inside(time),) for time in (0.1 * min(durations), 0.5 * max(durations))]


_TAKEN_UP_OR_ZEROED = (
    Form(
        "slack",
        (EffectParameter("slack_strain", "", 0.0, 0.2, 0.005, "some tenths of a per cent of the gauge length"),),
        driving_strain=_slack,
    ),
    Form(
        "toe",
        (
            EffectParameter("slack_strain", "", 0.0, 0.2, 0.005, "some tenths of a per cent of the gauge length"),
            EffectParameter(
                name="take_up_strain",
                unit="",
                lower=0.001,
                upper=0.5,
                centre=0.02,
                scale=0.8,
                log=True,
                starts=(0.01, 0.04),
                reason="grips bite and specimens straighten over some times the slack",
            ),
        ),
        driving_strain=_toe,
    ),
    Form(
        "shift",
        (EffectParameter("strain_zero_error", "", -0.2, 0.2, 0.005, "some tenths of a per cent"),),
        driving_strain=_shift,
    ),
)


EFFECT = Effect(
    name="strain_offset",
    title="offset of the strain",
    physics=(
        "Slack in the load train is recorded as strain (toe), the strain was zeroed at the wrong length or its zero "
        "creeps while a camera warms up, or one face of a bent or misaligned strip was measured while it was pulled "
        "straight.\n"
        "Amplitude: recorded strain that the specimen did not see. The true stress was made of it, or (measured "
        "section) not."
    ),
    source=(
        "ASTM D638, annex A1 (toe compensation); Timoshenko & Gere 1961, Theory of Elastic Stability, section 1.12 "
        "(initial curvature); ASTM E1012 (bending); Ma, Pang & Ma 2012, Meas. Sci. Technol. 23, 025403 (cameras)"
    ),
    shows_in="the onset of a record and, at zero load, its unloading; a wrong zero only bends the hardening",
    kind="rig",
    forms=(
        *_TAKEN_UP_OR_ZEROED,
        *(form.measured_section() for form in _TAKEN_UP_OR_ZEROED),
        Form(
            "settling",
            (EffectParameter("settled_strain", "", -0.2, 0.2, 0.005, "some tenths of a per cent"), _TIME),
            driving_strain=_settling,
            starts=_durations,
            variant=True,
        ),
        Form(
            "straightening",
            (
                EffectParameter("straightening_strain", "", -0.2, 0.2, 0.005, "bending by some tenths of a per cent"),
                _PULL,
            ),
            driving_strain=_straightening,
            starts=_pulls,
            variant=True,
        ),
        Form(
            "seating",
            (EffectParameter("seating_strain", "", 0.0, 0.2, 0.005, "some tenths of a per cent"), _SEAT),
            driving_strain=_seating,
            starts=_pulls,
            variant=True,
        ),
    ),
)
