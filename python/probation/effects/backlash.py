"""What moves behind a backlash: a slider that a value takes along once it has gone so far."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation import _core

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def behind(value: FloatArray, width: float, begin: float = np.nan) -> FloatArray:
    """The slider's place (n,), never further than `width` from a value (n,); it begins with it, or at `begin`."""
    return _core.behind_backlash(value, width, begin)


def path_since_reversal(strain: FloatArray) -> FloatArray:
    """Length of the path (n,) since the straining last turned; infinite before it first does."""
    steps = np.diff(strain, prepend=strain[0])
    moving = np.flatnonzero(steps)
    turned = moving[1:][np.sign(steps[moving[1:]]) != np.sign(steps[moving[:-1]])] - 1
    path = np.cumsum(np.abs(steps))
    last = np.searchsorted(turned, np.arange(len(strain)), side="right") - 1
    return np.where(last >= 0, path - path[turned[last]] if turned.size else 0.0, np.inf)
