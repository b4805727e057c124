"""Where on its way a specimen is: the branch of its strain history, and how far it has come on it."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def branches(view: RecordView) -> list[slice]:
    """Instants of one direction of straining each: loading, dwell, unloading; a turn ends one and begins the next."""
    turns = np.flatnonzero(np.diff(np.sign(view.direction))) + 1
    borders = [0, *turns.tolist(), len(view) - 1]
    return [slice(first, last + 1) for first, last in pairwise(borders)]


def direction(view: RecordView, part: slice) -> float:
    """Of straining on a branch: +1, -1, or 0 in a dwell."""
    return float(np.sign(view.direction[part.start]))


def progress(view: RecordView, part: slice) -> FloatArray:
    """How far the specimen has come on a branch, not decreasing; shape (n_part,).

    Strain from the first branch's zero, or from the turn where another begins [-]; time in a dwell [s].
    """
    sign = direction(view, part)
    if sign == 0.0:
        return np.asarray(view.time[part] - view.time[part.start])
    strain = view.true_strain[part]
    begin = 0.0 if part.start == 0 else float(strain[0])
    return np.asarray(np.maximum.accumulate(sign * (strain - begin)))
