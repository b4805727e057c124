"""Force and strain are not recorded at the same instant."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.maxwell_element import maxwell_element

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def _lag(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The force of a seconds ago, made a true stress with the strain of now."""
    return delayed(view.time, stress / view.stretch, values[0]) * view.stretch


def delayed(time: FloatArray, samples: FloatArray, delay: float) -> FloatArray:
    """`samples` a `delay` [s] later: a cubic with three-point slopes, constant before the start and straight
    after the end.
    """
    if delay == 0.0:
        return samples
    slopes = np.gradient(samples, time)
    wanted = time - delay
    here = np.clip(np.searchsorted(time, wanted, side="right") - 1, 0, len(time) - 2)
    step = time[here + 1] - time[here]
    u = (wanted - time[here]) / step
    rise = samples[here + 1] - samples[here]
    bend = (1.0 - u) * (step * slopes[here] - rise) + u * (rise - step * slopes[here + 1])
    interpolated = samples[here] + u * rise + u * (1.0 - u) * bend
    beyond = samples[-1] + slopes[-1] * (wanted - time[-1])
    return np.where(wanted < time[0], samples[0], np.where(wanted > time[-1], beyond, interpolated))


def _filter(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The force by a late: a part of that in a filter of first order, the rest a delay.

    Any filter acts on what is slow by its delay and by how much it spreads; these two fit both.
    """
    if values[0] <= 0.0:
        return stress
    constant = values[0] * values[1]
    force = delayed(view.time, stress / view.stretch, values[0] - constant)
    if constant > 0.0:
        force = force - maxwell_element(view.time, force, constant)
    return np.asarray(force * view.stretch)


def _strain_filter(view: RecordView, values: Values) -> FloatArray:
    """The strain came through a filter of first order, of time constant a: it was ahead by a times its rate."""
    return view.true_strain + values[0] * view.signed_rate


EFFECT = Effect(
    name="force_strain_lag",
    title="lag between force and strain",
    physics=(
        "Filters or separate clocks delay one channel against the other.\n"
        "Amplitude: by how much the force comes late (negative: the strain does, as it does by a filter of its own)."
    ),
    source="ASTM E1942 (data acquisition in mechanical testing: delays and filters); Thomson 1949, Proc. IEE 96, 487",
    shows_in="fast records, rate jumps and reversals, where the stress changes quickly",
    kind="rig",
    coordinate="strain_rate",
    forms=(
        Form(
            "delay",
            (EffectParameter("delay_s", "s", -20.0, 20.0, 0.3, "filters and video extensometers lag by 0.1 to 1 s"),),
            recorded_stress=_lag,
        ),
        Form(
            "filter",
            (
                EffectParameter("lag_s", "s", 0.0, 20.0, 0.3, "amplifiers filter at 0.2 Hz to 1 kHz"),
                EffectParameter(
                    name="filtered_part",
                    unit="",
                    lower=0.0,
                    upper=1.0,
                    centre=0.7,
                    scale=0.3,
                    starts=(0.95, 0.5),
                    reason="1 is a filter of first order; Bessel's of higher order have less",
                ),
            ),
            recorded_stress=_filter,
            variant=True,
        ),
        Form(
            "strain_filter",
            (EffectParameter("strain_lag_s", "s", 0.0, 20.0, 0.3, "video extensometers average over 0.1 to 1 s"),),
            driving_strain=_strain_filter,
            variant=True,
        ),
    ),
)
