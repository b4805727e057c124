"""The load cell reads more on the way down."""

from __future__ import annotations

import itertools
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.backlash import behind
from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.effects.presliding import presliding
from probation.effects.visible import unloads

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_SIZE = EffectParameter(
    name="reversibility_error",
    unit="",
    lower=0.0,
    upper=0.3,
    scale=0.01,
    reason="of the largest force; ISO 7500-1 allows 0.75 % in class 0.5, 1.5 % in class 1",
)

CONTACTS = 8
"""That slide one after the other."""

_REACH = EffectParameter(
    name="reach_of_friction",
    unit="",
    lower=0.005,
    upper=2.0,
    centre=0.2,
    scale=1.0,
    log=True,
    starts=(0.08, 0.3),
    reason="contacts of a load train slide once the force has changed by some tenths of the largest one",
)


def _loop(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """On the way down from the largest force so far M a force F reads F + 4 a F (1 - F / M); exact at M and at 0."""
    force = np.maximum(stress / view.stretch, 0.0)
    largest = np.maximum.accumulate(force)
    part = np.divide(force, largest, out=np.ones_like(force), where=largest > 0.0)
    return np.asarray(stress + 4.0 * values[0] * force * (1.0 - part) * view.stretch)


def _friction(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The reading stands still until the force has fallen by w, then follows w above it (play); w is a times the
    record's largest force.
    """
    force = stress / view.stretch
    width = values[0] * float(np.max(np.abs(view.nominal_data)))
    # What lags behind stays between the force and w above it: a slider half way between, begun at the force.
    reading = behind(force + 0.5 * width, 0.5 * width, force[0])
    return reading * view.stretch


def _presliding(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """Friction that builds up over a way of the force, on the way up, too: the reading is F - a M z / 2, with
    dz = (sgn dF - z) |dF| / r, exact between turns; M is the record's largest force, r a part of it.
    """
    force = stress / view.stretch
    largest = max(float(np.max(np.abs(force))), 1e-300)
    turns = itertools.pairwise(_turns(force))
    pieces = ((slice(begin + 1, end + 1), begin, float(np.sign(force[end] - force[begin]))) for begin, end in turns)
    slid = presliding(force, pieces, values[1] * largest)
    return np.asarray((force - 0.5 * values[0] * largest * slid) * view.stretch)


def _stops(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The same with contacts that stick until each slides at a force of its own, evenly from 0 to r."""
    force = stress / view.stretch
    largest = max(float(np.max(np.abs(force))), 1e-300)
    holds = (np.arange(CONTACTS) + 0.5) / CONTACTS * values[1] * largest
    held = np.zeros((len(force), CONTACTS))
    for begin, end in itertools.pairwise(_turns(force)):
        gone = force[begin + 1 : end + 1, np.newaxis] - force[begin]
        held[begin + 1 : end + 1] = np.clip(held[begin] + gone, -holds, holds)
    slid = held.sum(axis=1) / holds.sum()
    return np.asarray((force - 0.5 * values[0] * largest * slid) * view.stretch)


def _turns(force: FloatArray) -> list[int]:
    """Samples between which a force goes one way only, the first and the last among them."""
    way = np.sign(np.diff(force))
    return [0, *(np.flatnonzero(np.diff(way)) + 1).tolist(), len(way)]


EFFECT = Effect(
    name="cell_hysteresis",
    title="hysteresis of the load cell",
    physics=(
        "The load cell, or friction in the load train, reads a falling force as larger than it is.\n"
        "Amplitude: largest difference between the ways down and up, over the largest force."
    ),
    source=(
        "ISO 376 and ISO 7500-1 (relative reversibility error); Krasnosel'skii & Pokrovskii 1989 (play); Dahl 1968, "
        "Prandtl 1928 (friction that builds up)"
    ),
    shows_in="unloading, where the force falls by a good part",
    kind="rig",
    coordinate="force",
    forms=(
        Form("loop", (_SIZE,), recorded_stress=_loop, needs=unloads),
        Form("friction", (_SIZE,), recorded_stress=_friction, needs=unloads),
        Form("presliding", (_SIZE, _REACH), recorded_stress=_presliding, needs=unloads, variant=True),
        Form("stops", (_SIZE, _REACH), recorded_stress=_stops, needs=unloads, variant=True),
    ),
    odds=0.3,
)
