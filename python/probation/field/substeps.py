"""How many steps of the scheme a block takes from sample to sample."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.field.errors import drawn_errors
from probation.field.pixels import Pixels, identify_pixels, with_more_noise
from probation.law.schemes import SA3
from probation.settings.certificate import CERTIFICATE
from probation.settings.field import FIELD
from probation.settings.reading import READING

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.field.errors import Errors
    from probation.field.pixels import Way
    from probation.field.samples import BoolArray
    from probation.field.source import Samples


def needed_substeps(
    way: Way, time: FloatArray, strain: Samples, stress: Samples, used: BoolArray, chance: np.random.Generator
) -> int:
    """Steps that make the error of the scheme negligible against the standard errors, as `fit` takes them.

    Parameters
    ----------
    time : ndarray, shape (n_times,) [s]
    strain, stress, used : ndarray, shape (pixels, n_times) [-], [MPa], bool
    chance : Generator
        Of the noise that the standard errors are drawn with.
    """
    there = np.flatnonzero(np.count_nonzero(used, axis=1) >= READING.fewest_samples)
    if len(there) == 0:
        return 1
    tried = there[np.unique(np.linspace(0, len(there) - 1, FIELD.scheme_pixels).astype(np.intp))]
    strain, stress, used = strain[tried], stress[tried], used[tried]
    precise = replace(way, scheme=SA3())
    reference = identify_pixels(precise, time, strain, stress, used, FIELD.reference_substeps)
    alone, together = np.arange(len(tried)), np.zeros(len(tried), dtype=np.intp)
    more_strain, more_stress, level = with_more_noise(time, strain, stress, used, alone, chance)
    again = identify_pixels(precise, time, more_strain, more_stress, used, FIELD.reference_substeps)
    errors = drawn_errors(reference, [(alone, again)], level, together)
    steps = 1
    while steps < CERTIFICATE.most_substeps:
        shift = _shift(identify_pixels(way, time, strain, stress, used, steps), reference, errors)
        if shift <= CERTIFICATE.negligible_scheme_shift:
            break
        steps = min(
            max(int(np.ceil(steps * np.sqrt(shift / CERTIFICATE.negligible_scheme_shift))), steps + 1),
            CERTIFICATE.most_substeps,
        )
    return steps


def _shift(pixels: Pixels, reference: Pixels, errors: Errors) -> float:
    """How far the estimates are from the reference [standard errors]: the worst of the parameters and the product."""
    good = pixels.identified & reference.identified
    if not good.any():
        return 0.0
    values, expected = pixels.parameters[good], reference.parameters[good]
    moved = np.column_stack([values - expected, values[:, 0] * values[:, 1] - expected[:, 0] * expected[:, 1]])
    error = np.column_stack([errors.parameters[good], errors.product[good]])
    shift = np.abs(np.divide(moved, error, out=np.zeros_like(moved), where=error > 0.0))
    return float(np.max(np.percentile(shift, FIELD.part_of_negligible_error, axis=0)))
