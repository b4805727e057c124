"""Standard errors that know of the strain's noise: every pixel is identified once more with as much noise again.

What the estimate does then is one draw of its error. Neighbours have the same noise and much the same history, so that
their draws together tell how large the errors are; the engine's own standard error, which takes the residual for white
noise of the stress, tells the pixels of a neighbourhood apart.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.pixels import Pixels

SIDE = 8
"""Pixels along a neighbourhood."""
FEWEST = 16
"""Draws in a neighbourhood, below which those of the whole block are taken."""


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


def drawn_errors(first: Pixels, again: Pixels, level: FloatArray, shape: tuple[int, int]) -> Errors:
    """Standard errors from estimates and estimates with as much noise again.

    Parameters
    ----------
    first, again : Pixels
    level : ndarray, shape (pixels,) [MPa]
        Noise of each pixel's stress.
    shape : (int, int)
        Of the block.
    """
    both = first.identified & again.identified
    with np.errstate(invalid="ignore", divide="ignore"):
        moved = (again.parameters - first.parameters) / first.standard_error
        product = first.parameters[:, 0] * first.parameters[:, 1]
        moved_product = again.parameters[:, 0] * again.parameters[:, 1] / product - 1.0
        own = np.hypot(*(first.standard_error / first.parameters)[:, :2].T)
        more = (again.rms_residual**2 - first.rms_residual**2) / level**2
    held = first.standard_error == 0.0
    moved[held] = 0.0
    factors = np.sqrt(np.stack([_pooled(moved[:, k] ** 2, both, shape) for k in range(3)], axis=1))
    errors = np.where(held, 0.0, first.standard_error * factors)
    with np.errstate(invalid="ignore", divide="ignore"):
        relative = own * np.sqrt(_pooled((moved_product / own) ** 2, both, shape))
    noise = level * np.sqrt(np.maximum(_pooled(more, both, shape), 0.0))
    there = first.identified
    return Errors(
        np.where(there[:, None], errors, np.nan),
        np.where(there, np.abs(product) * relative, np.nan),
        np.where(there, noise, np.nan),
    )


def _pooled(values: FloatArray, good: np.ndarray, shape: tuple[int, int]) -> FloatArray:
    """Mean over each pixel's neighbourhood, or over the block where that has too few; NaN where that has none."""
    y, x = np.divmod(np.arange(len(values)), shape[1])
    tile = y // SIDE * (-(-shape[1] // SIDE)) + x // SIDE
    number = np.bincount(tile[good], minlength=tile.max() + 1)
    total = np.bincount(tile[good], weights=values[good], minlength=tile.max() + 1)
    everywhere = total.sum() / number.sum() if number.sum() else np.nan
    return np.asarray(np.where(number >= FEWEST, total / np.maximum(number, 1), everywhere)[tile])
