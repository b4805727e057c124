"""The noise of the strain as a law propagates it to the stress, so that it moves with the law's parameters."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from probation.noise.whitener import Whitener

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.inference.strain_noise import StrainNoise
    from probation.law.modal import Law

KEPT = 2
"""Laws whose noise is kept, since its factor is slow to make: a search compares a law with the one before."""


@dataclass(frozen=True, eq=False)
class MovingNoise:
    r"""What strain noise adds to the covariance of a fit residual, :math:`\Sigma(\theta) = \Sigma_y + A A^T`.

    Attributes
    ----------
    still : Whitener
        Of the noise of the stress.
    strain : tuple of StrainNoise or None
        By record; None where its strain noise does not matter.
    """

    still: Whitener
    strain: tuple[StrainNoise | None, ...]
    _made: dict[bytes, Whitener] = field(default_factory=dict, repr=False)

    def at(self, law: Law) -> Whitener:
        """Of both together, at a law."""
        key = law.parameters.tobytes()
        if key not in self._made:
            while len(self._made) >= KEPT:
                del self._made[next(iter(self._made))]
            noises = (
                noise if own is None else noise.with_propagated(own.propagated(law))
                for noise, own in zip(self.still.noises, self.strain, strict=True)
            )
            self._made[key] = Whitener(tuple(noises))
        return self._made[key]

    def slopes(self, law: Law, residual: FloatArray, wanted: Sequence[int]) -> FloatArray:
        """(d A / d theta) delta for the law's parameters number `wanted`, shape (n_samples, wanted) [MPa per unit].

        delta are the likeliest strain errors of a fit residual (n_samples,) [MPa].
        """
        whitener = self.at(law)
        slopes = np.zeros((len(residual), len(wanted)))
        for own, noise, rows in zip(self.strain, whitener.noises, whitener.slices, strict=True):
            if own is not None:
                slopes[rows] = own.slopes(law, noise.strain_errors(residual[rows]), wanted)
        return slopes
