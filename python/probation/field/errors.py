"""Standard errors that know of the strain's noise: every pixel is identified once more with as much noise again.

What the estimate does then is one draw of its error. Neighbours whose records are as long have the same noise and much
the same history, so that their draws together tell how large the errors are; the engine's own standard error, which
takes the residual for white noise of the stress, tells the pixels of a neighbourhood apart. Pixels with few such
neighbours are drawn more often.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.settings.field import FIELD

if TYPE_CHECKING:
    from collections.abc import Iterator, Sequence

    from probation._arrays import FloatArray
    from probation.field.pixels import Pixels
    from probation.field.samples import BoolArray, IndexArray


@dataclass(frozen=True)
class Errors:
    """Of the pixels of a block.

    Attributes
    ----------
    parameters : ndarray, shape (pixels, 3)
    product : ndarray, shape (pixels,)
        Of E_u times the second parameter.
    noise : ndarray, shape (pixels,) [MPa]
        rms_residual that noise alone leaves.
    """

    parameters: FloatArray
    product: FloatArray
    noise: FloatArray


def neighbourhoods(used: BoolArray, shape: tuple[int, int]) -> IndexArray:
    """Number of each pixel's neighbourhood: within a square of pixels, records of the same sixteenths of the time.

    Parameters
    ----------
    used : ndarray of bool, shape (pixels, n_times)
    shape : (int, int)
        Of the block.
    """
    y, x = np.divmod(np.arange(len(used)), shape[1])
    side = FIELD.neighbourhood
    tile = y // side * (-(-shape[1] // side)) + x // side
    within = np.where(used.any(axis=1), used.shape[1] - np.argmax(used[:, ::-1], axis=1), 0)
    return np.asarray(tile * (FIELD.lengths + 1) + -(-within * FIELD.lengths // used.shape[1]), dtype=np.intp)


def rounds(identified: BoolArray, neighbourhood: IndexArray) -> Iterator[IndexArray]:
    """Pixels to draw, round by round, until each neighbourhood has had `FIELD.fewest_draws` draws."""
    mates = np.bincount(neighbourhood[identified], minlength=neighbourhood.max() + 1)[neighbourhood]
    times = np.where(identified, -(-FIELD.fewest_draws // np.maximum(mates, 1)), 0)
    return (np.flatnonzero(times > done) for done in range(times.max()))


def drawn_errors(
    first: Pixels, draws: Sequence[tuple[IndexArray, Pixels]], level: FloatArray, neighbourhood: IndexArray
) -> Errors:
    """Standard errors from estimates and estimates with as much noise again.

    Parameters
    ----------
    draws : sequence of (ndarray of int, Pixels)
        Of each round, which pixels, and their estimates with more noise.
    level : ndarray, shape (pixels,) [MPa]
        Noise of each pixel's stress.
    neighbourhood : ndarray of int, shape (pixels,)
    """
    own, held = first.standard_error, first.standard_error == 0.0
    product = first.parameters[:, 0] * first.parameters[:, 1]
    with np.errstate(invalid="ignore"):  # infinite where nothing is known of a parameter, whatever the other one is
        parts = own[:, :2] * first.parameters[:, 1::-1]
        own_product = np.where(np.isfinite(own[:, :2]).all(axis=1), np.hypot(*parts.T), np.inf)
    squares: list[FloatArray] = [np.empty((0, 5))]
    where = [np.empty(0, dtype=np.intp)]
    for pixels, again in draws:
        with np.errstate(invalid="ignore", divide="ignore"):
            moved = np.where(held[pixels], 0.0, (again.parameters - first.parameters[pixels]) / own[pixels])
            moved_product = again.parameters[:, 0] * again.parameters[:, 1] - product[pixels]
            more = (again.rms_residual**2 - first.rms_residual[pixels] ** 2) / level[pixels] ** 2
            drawn = np.column_stack([moved**2, (moved_product / own_product[pixels]) ** 2, more])
        squares.append(drawn[again.identified])
        where.append(neighbourhood[pixels[again.identified]])
    pooled = _means(np.concatenate(squares), np.concatenate(where), neighbourhood)
    factors = np.sqrt(np.maximum(pooled, 0.0))
    there = first.identified
    with np.errstate(invalid="ignore"):
        return Errors(
            np.where(there[:, None], np.where(held, 0.0, own * factors[:, :3]), np.nan),
            np.where(there, own_product * factors[:, 3], np.nan),
            np.where(there, level * factors[:, 4], np.nan),
        )


def _means(values: FloatArray, where: IndexArray, neighbourhood: IndexArray) -> FloatArray:
    """Mean of each column over each pixel's neighbourhood; NaN where that has no values."""
    count = int(neighbourhood.max()) + 1
    number = np.bincount(where, minlength=count)
    total = np.stack([np.bincount(where, weights=column, minlength=count) for column in values.T], axis=1)
    with np.errstate(invalid="ignore"):
        return np.asarray((total / number[:, None])[neighbourhood])
