"""A guide rubs between the specimen and the load cell."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.backlash import behind
from probation.effects.effect import Effect, EffectParameter, Form, Values
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


def _turns(view: RecordView) -> list[tuple[int, float]]:
    """Instants from which on the elongation goes one way by more than its noise, and +1 or -1, way out or back."""
    strain = view.recorded_strain
    steps = np.diff(behind(strain, EFFECTS.return_over_noise * view.strain_noise), prepend=strain[0])
    turns: list[tuple[int, float]] = []
    last = 0
    for moving in np.flatnonzero(steps).tolist():
        way = float(np.sign(steps[moving]))
        if not turns or turns[-1][1] != way:
            turns.append((last + int(np.argmin(way * strain[last : moving + 1])), way))
        last = moving
    return turns


def _pieces(view: RecordView) -> Iterator[tuple[slice, int, float]]:
    """Instants of one way each, where they begin, and the way."""
    turns = _turns(view)
    ends = [begin for begin, _ in turns[1:]] + [len(view.time) - 1]
    for (begin, way), end in zip(turns, ends, strict=True):
        yield slice(begin + 1, end + 1), begin, way


def _sliding(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """A constant force against the motion, over the initial section; it stays in a dwell, and is 0 at a turn."""
    way = np.zeros(len(stress))
    for piece, begin, sign in _pieces(view):
        way[begin], way[piece] = 0.0, sign
    return np.asarray(stress + values[0] * way * view.stretch)


def _building_up(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same, built up over a way w of the stretch from every turn on: dz = (sgn dl - z) |dl| / w, exact; f z."""
    slid, stretch = np.zeros(len(stress)), view.stretch
    for piece, begin, sign in _pieces(view):
        gone = np.maximum.accumulate(np.maximum(sign * (stretch[piece] - stretch[begin]), 0.0))
        slid[piece] = sign + (slid[begin] - sign) * np.exp(-gone / values[1])
    return np.asarray(stress + values[0] * slid * stretch)


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
