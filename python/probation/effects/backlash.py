"""What moves behind a backlash: a slider that a strain takes along once it has gone so far."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray


def behind(strain: FloatArray, width: float) -> FloatArray:
    """The slider's place, shape (n,), never further than `width` from the strain (n,); it begins with it."""
    place, path = float(strain[0]), []
    for now in strain.tolist():
        place = min(max(place, now - width), now + width)
        path.append(place)
    return np.array(path)
