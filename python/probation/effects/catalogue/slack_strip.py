"""A strip goes slack: there is no force below zero."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.effects.effect import Effect, EffectParameter, Form, Values
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

_LOADED, _NONE = 0.1, 0.02
"""Parts of the largest force [-]: above the first a record has been loaded, within the second there is no force.

The second is above the zero error of a load cell and below what a strip that has buckled still carries.
"""

_SIZE = EffectParameter("slack_part", "", 0.0, 1.0, 1.0, "a thin strip buckles at once (1), a stout bar never (0)")


def _back_to_no_force(view: RecordView) -> NDArray[np.bool_]:
    """Samples without a pull after a loading, while the strain is below its largest; shape (n_samples,)."""
    force = view.data / view.sampled(view.stretch)
    largest = float(np.max(force))
    loaded = (np.maximum.accumulate(force) > _LOADED * largest) & (largest > 0.0)
    back = view.sampled(view.true_strain) < view.sampled(view.largest_strain)
    return np.asarray(loaded & back & (force < _NONE * largest))


def slack_intervals(view: RecordView) -> list[tuple[int, int]]:
    """First and last sample of each segment without force after a loading, while the strain is below its largest."""
    force = view.data / view.sampled(view.stretch)
    slack = _back_to_no_force(view) & (force > -_NONE * float(np.max(force)))
    edges = np.flatnonzero(np.diff(np.concatenate([[0], slack.astype(np.int8), [0]])))
    return [(int(a), int(b) - 1) for a, b in zip(edges[::2], edges[1::2], strict=True) if b - a >= EFFECTS.fewest_slack]


def _inside(view: RecordView) -> NDArray[np.bool_]:
    """Instants at which the strip is slack, shape (n,)."""
    slack = np.zeros(len(view), dtype=np.bool_)
    for first, last in slack_intervals(view):
        slack[first * view.stride : last * view.stride + 1] = True
    return slack


def _own_strain(view: RecordView, values: Values) -> FloatArray:
    """While there is no force the strip goes straight from its strain at the beginning to that at the end of it."""
    strain = view.true_strain.copy()
    for first, last in slack_intervals(view):
        here = slice(first * view.stride, last * view.stride + 1)
        begin, end = float(view.true_strain[here][0]), float(view.true_strain[here][-1])
        own = np.linspace(begin, end if last < len(view.data) - 1 else begin, len(view.time[here]))
        strain[here] += values[0] * (own - view.true_strain[here])
    return strain


def _no_force(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """While it is slack the part a of the stress is missing."""
    return np.where(_inside(view), (1.0 - values[0]) * stress, stress)


def _no_compression(view: RecordView, values: Values, stress: FloatArray) -> FloatArray:
    """The part a of every stress below zero is missing."""
    return np.where(stress < 0.0, (1.0 - values[0]) * stress, stress)


def _goes_slack(views: Sequence[RecordView]) -> bool:
    return any(slack_intervals(view) for view in views)


def _is_pressed(views: Sequence[RecordView]) -> bool:
    """Whether any record comes to no force or below it after a loading: a stout strip still carries a part of it."""
    return any(bool(np.any(_back_to_no_force(view))) for view in views)


EFFECT = Effect(
    name="slack_strip",
    title="a strip that goes slack",
    physics=(
        "Taken back below zero force, a strip buckles and hangs: the force stays at zero until it is taut again.\n"
        "Amplitude: part of the compression that is missing; it keeps a strain of its own, or follows."
    ),
    source="Euler 1744 (buckling); ASTM D412 and ISO 37 (strips of elastomer pull only)",
    shows_in="unloading down to zero force, where the force stays, or falls less than it would",
    kind="rig",
    forms=(
        Form(
            "own_strain",
            (_SIZE,),
            driving_strain=_own_strain,
            recorded_stress=_no_force,
            converts=False,
            needs=_goes_slack,
        ),
        Form("no_compression", (_SIZE,), recorded_stress=_no_compression, needs=_is_pressed),
    ),
)
