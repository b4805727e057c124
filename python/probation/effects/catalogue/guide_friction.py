"""A guide rubs between the specimen and the load cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.backlash import behind
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.presliding import presliding
from probation.effects.visible import unloads
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_FRICTION = EffectParameter(
    "friction_MPa", "MPa", 0.0, 20.0, 0.3, "about 1 % of a yield stress: bearings and seals that rub with some newtons"
)
_WAY = EffectParameter(
    name="way_to_sliding",
    unit="",
    lower=1e-4,
    upper=0.3,
    centre=0.005,
    scale=1.5,
    log=True,
    starts=(0.002, 0.02),
    reason="of the gauge length: what rubs is held by springs of its own, rods and seals",
)

_CHANGE = EffectParameter(
    name="change_to_sliding_MPa",
    unit="MPa",
    lower=1e-3,
    upper=20.0,
    centre=0.1,
    scale=1.5,
    log=True,
    starts=(0.03, 0.3),
    reason="a rod slides as soon as the force has changed by about its friction",
)


def _pieces(view: RecordView) -> Iterator[tuple[slice, int, float]]:
    """Instants from which the elongation goes one way by more than its noise, where they begin, and +1 (out) or -1.

    A dwell belongs to what comes before it: they begin at the last of the furthest strains.
    """
    strain = view.recorded_strain
    steps = np.sign(np.diff(behind(strain, EFFECTS.return_over_noise * view.strain_noise), prepend=strain[0]))
    moving = np.flatnonzero(steps)
    if moving.size == 0:
        return
    turning = np.flatnonzero(np.diff(steps[moving], prepend=0.0))
    begins = []
    for k in turning.tolist():
        last, way = int(moving[k - 1]) if k else 0, steps[moving[k]]
        furthest = way * strain[last : moving[k] + 1]
        begins.append(last + int(np.flatnonzero(furthest <= furthest.min() + 2.0 * view.strain_noise)[-1]))
    for k, begin, end in zip(turning.tolist(), begins, [*begins[1:], len(strain) - 1], strict=True):
        yield slice(begin + 1, end + 1), begin, float(steps[moving[k]])


def _sliding(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """A constant force against the motion, over the initial section; it stays in a dwell, and is 0 at a turn."""
    way = np.zeros(len(stress))
    for piece, begin, sign in _pieces(view):
        way[begin], way[piece] = 0.0, sign
    return np.asarray(stress + values[0] * way * view.stretch)


def _building_up(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same, built up over a way w of the stretch from every turn on: dz = (sgn dl - z) |dl| / w, exact; f z."""
    stretch = view.stretch
    return np.asarray(stress + values[0] * presliding(stretch, _pieces(view), values[1]) * stretch)


def _with_the_force(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same where the force moves what rubs, a rod behind a seal: it turns where the force does, in a dwell, too.

    It builds up to a over a change of the nominal stress by n, twice that from way to way; then the rod slides.
    """
    force = stress / view.stretch
    built_up = (force - behind(force, values[1], force[0])) / values[1]
    return np.asarray((force + values[0] * built_up) * view.stretch)


EFFECT = Effect(
    name="guide_friction",
    title="friction of a guide",
    physics=(
        "What guides the grip or the crosshead rubs between specimen and load cell: the cell reads more while the "
        "specimen is pulled, less on the way back, and a step at every turn. What the force moves turns with it.\n"
        "Amplitude: that force over the initial section."
    ),
    source="Dahl 1968 (friction that builds up); Krasnosel'skii & Pokrovskii 1989 (with the force: a stop)",
    shows_in="unloading: a step of the force where the motion turns, or the force",
    kind="rig",
    coordinate="time",
    forms=(
        Form("sliding", (_FRICTION,), recorded_stress=_sliding, needs=unloads),
        Form("building_up", (_FRICTION, _WAY), recorded_stress=_building_up, needs=unloads, variant=True),
        Form("with_the_force", (_FRICTION, _CHANGE), recorded_stress=_with_the_force, needs=unloads, variant=True),
    ),
    odds=0.3,
)
