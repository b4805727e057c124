"""The mean square of errors over records, in which samples with much noise do not decide."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.noise.model import NoiseModel


def mean_square(errors: Sequence[FloatArray], noises: Sequence[NoiseModel]) -> float:
    """Of all records' samples, each with its `NoiseModel.weight` [MPa^2].

    Parameters
    ----------
    errors : sequence of ndarray, shape (n,) [MPa]
        By record.
    noises : sequence of NoiseModel
        Of the same records.
    """
    weighted = [noise.weight * error**2 for error, noise in zip(errors, noises, strict=True)]
    return float(np.mean(np.concatenate(weighted)))
