"""Friction that builds up over a way from every turn on, before anything slides."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Iterable

    from probation._arrays import FloatArray


def presliding(place: FloatArray, pieces: Iterable[tuple[slice, int, float]], reach: float) -> FloatArray:
    """Friction over its largest, (n,): dz = (sgn dx - z) |dx| / reach (Dahl 1968), exact on pieces of one way.

    Parameters
    ----------
    place : ndarray, shape (n,)
        x: a force, or a way; by what it goes back within a piece, friction does not.
    pieces : iterable of (slice, int, float)
        Each one's instants, the instant where it begins, and its sign.
    reach : float
        In the unit of x.
    """
    built_up = np.zeros(len(place))
    for piece, begin, sign in pieces:
        gone = np.maximum.accumulate(np.maximum(sign * (place[piece] - place[begin]), 0.0))
        built_up[piece] = sign + (built_up[begin] - sign) * np.exp(-gone / reach)
    return built_up
