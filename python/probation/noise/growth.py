"""How the size of the noise changes along a record: not at all, with the section, or in bursts."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import uniform_filter1d

from probation.noise.local_size import local_size
from probation.noise.segments import leftover
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.noise.model import Growth
    from probation.noise.record_residual import RecordResidual


def growth_of(record: RecordResidual, residual: FloatArray, coarse: bool) -> tuple[Growth, FloatArray]:
    """How the size of the noise changes along a record.

    The size of neighbouring differences is regressed on the strain: a slope near 1 is constant force noise on a
    shrinking section. What then still comes in bursts is followed by a moving mean, drawn towards 1 by as much as
    chance would move it.
    """
    count = len(residual)
    if coarse:
        return "constant", np.ones(count)
    left = leftover(residual, record.jumps)
    # Second differences see no transient of the model; a correlated noise keeps its size in them.
    size = np.abs(np.convolve(left, [1.0, -2.0, 1.0], mode="same"))
    size = uniform_filter1d(size, NOISE.growth_window, mode="nearest")
    if not np.any(size > 0.0):
        return "constant", np.ones(count)
    size = np.maximum(size, NOISE.least_size * float(np.mean(size)))
    strain = record.true_strain - record.true_strain.mean()
    spread = float(strain @ strain)
    growth: Growth = "constant"
    profile = np.ones(count)
    if spread > 0.0:
        logs = np.log(size)
        slope = float(strain @ logs) / spread
        error = float(np.std(logs - logs.mean() - slope * strain)) * np.sqrt(NOISE.growth_memory / spread)
        if slope > NOISE.force_slope and slope > NOISE.force_slope_errors * error:
            growth, profile = "force", np.exp(record.true_strain)
    profile = profile / np.sqrt(np.mean(profile**2))
    local = local_size(left / profile)
    if local is not None:
        profile, growth = profile * local, "local"
    return growth, profile / np.sqrt(np.mean(profile**2))
