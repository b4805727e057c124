"""How far specimens differ is itself uncertain: what that adds to a null distribution.

Noise is whitened with one estimate of the specimens' scatter. From a few replicates the true one may be half or twice
as large, and the deviations of specimens are then no normal numbers of the estimated size but a mixture of smaller and
larger ones, which reaches further: a test that takes the estimate for the truth alarms too often.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation._arrays import FloatArray


@dataclass(frozen=True, eq=False)
class UncertainScatter:
    """Deviations of specimens whose standard deviations are known as draws.

    Attributes
    ----------
    columns : tuple of ndarray, shape (N, k)
        By specimen: whitened stress of deviations of one standard deviation, as it was estimated.
    ratios : ndarray, shape (n_draws, k)
        Draws of the standard deviations, over the estimated ones.
    """

    columns: tuple[FloatArray, ...]
    ratios: FloatArray

    def seen_by(self, change: Callable[[FloatArray], FloatArray]) -> UncertainScatter:
        """The same in other coordinates of the records."""
        return replace(self, columns=tuple(change(columns) for columns in self.columns))

    def spread(
        self, noise: FloatArray, rng: np.random.Generator, reduced: Callable[[FloatArray], FloatArray]
    ) -> FloatArray:
        """Draws of white noise (size, m) with a drawn scatter each in place of the estimated one.

        Whitened with the estimate, noise of another scatter has the covariance I + W diag(ratio^2 - 1) W^T, W the
        columns of every specimen.

        Parameters
        ----------
        noise : ndarray, shape (size, m)
            Standard normal, in the coordinates of `reduced`.
        rng : Generator
        reduced : callable
            Columns (N, k) in those coordinates, (m, k).
        """
        drawn = self.ratios[rng.integers(len(self.ratios), size=len(noise))] ** 2 - 1.0
        scattered = noise.copy()
        for columns in self.columns:
            basis, upper = np.linalg.qr(reduced(columns))
            changed = np.einsum("ik,nk,jk->nij", upper, drawn, upper)
            values, vectors = np.linalg.eigh(changed)
            root = np.sqrt(np.maximum(1.0 + values, 0.0)) - 1.0
            along = np.einsum("nji,nj->ni", vectors, noise @ basis)
            scattered += np.einsum("nij,nj->ni", vectors, root * along) @ basis.T
        return scattered
