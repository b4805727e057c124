"""The residual of a fit that leaves the place of a gap out: what a refit smears comes back to where it belongs.

A law that is fitted to a gap bends its parameters towards it, and then errs everywhere a little. Where nothing is known
of the gap's form, the fit can still leave its place out (compare Kahl, Weber and Kschischo on localising hidden
inputs).
"""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.detection.where import Located
    from probation.noise.whitening import Whitened


def place_left_out(whitened: Whitened, located: Sequence[Located]) -> Whitened:
    """The same with a residual of base parameters that were fitted without the places that disturb the fit most.

    Places are taken one by one, as long as what all others leave becomes that much more like noise.

    Parameters
    ----------
    whitened : Whitened
    located : sequence of Located
        Places to choose from; whole records are tried, too.

    Returns
    -------
    Whitened
        As it was where no place disturbs the fit.
    """
    candidates = [_rows(whitened, place) for place in located[: DETECTION.most_places_left_out]]
    for part in whitened.slices:
        whole = np.zeros(len(whitened), dtype=bool)
        whole[part] = True
        candidates.append(whole)
    tangent = whitened.whiten([record.tangent for record in whitened.records])
    out, moved = np.zeros(len(whitened), dtype=bool), np.zeros(tangent.shape[1])
    score = float(whitened.residual @ whitened.residual)
    for _ in range(DETECTION.most_places_left_out):
        tried = [out | rows for rows in candidates]
        tried = [rows for rows in tried if rows.sum() > out.sum() and 1.0 - rows.mean() >= DETECTION.least_share_kept]
        if not tried:
            break
        moves = [_moved(tangent, whitened.residual, ~rows) for rows in tried]
        scores = [
            float(np.sum((whitened.residual - tangent @ move)[~rows] ** 2) + np.sum(rows))
            for move, rows in zip(moves, tried, strict=True)
        ]
        best = int(np.argmin(scores))
        if scores[best] > score - DETECTION.least_gain_of_a_place:
            break
        out, moved, score = tried[best], moves[best], scores[best]
    if not out.any():
        return whitened
    records = [replace(record, residual=record.residual - record.tangent @ moved) for record in whitened.records]
    return replace(whitened, records=tuple(records), residual=whitened.residual - tangent @ moved)


def _rows(whitened: Whitened, place: Located) -> NDArray[np.bool_]:
    rows = np.zeros(len(whitened), dtype=bool)
    index = [record.name for record in whitened.records].index(place.record)
    first = whitened.slices[index].start
    rows[first + place.samples.start : first + place.samples.stop] = True
    return rows


def _moved(tangent: FloatArray, residual: FloatArray, kept: NDArray[np.bool_]) -> FloatArray:
    """Step of the parameters that fits the rows kept."""
    size = np.linalg.norm(tangent, axis=0)
    size = np.where(size > 0.0, size, 1.0)
    step = np.linalg.lstsq(tangent[kept] / size, residual[kept], rcond=1e-8)[0]
    return np.asarray(step / size, dtype=np.float64)
