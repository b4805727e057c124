"""The noise of one record's fit residual: that of its stress, and that of its strain as a law propagates it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from probation.inference.strain_noise import StrainNoise
    from probation.law.modal import Law
    from probation.noise.model import NoiseModel

KEPT = 2
"""Laws whose noise model is kept, since its factor is slow to make: a search compares a law with the one before."""


@dataclass(frozen=True, eq=False)
class RecordNoise:
    r"""Covariance of a fit residual as a function of the law, :math:`\Sigma(\theta) = \Sigma_y + C C^T`.

    Attributes
    ----------
    stress : NoiseModel
        The part that does not depend on the law.
    strain : StrainNoise or None
        What the law propagates to the stress, C; None where nothing depends on the law.
    """

    stress: NoiseModel
    strain: StrainNoise | None = None
    _made: dict[bytes, NoiseModel] = field(default_factory=dict, repr=False)

    def at(self, law: Law) -> NoiseModel:
        """The noise of the residual of this law."""
        if self.strain is None:
            return self.stress
        key = law.parameters.tobytes()
        if key not in self._made:
            while len(self._made) >= KEPT:
                del self._made[next(iter(self._made))]
            self._made[key] = self.stress.with_carried(self.strain.carried(law))
        return self._made[key]

    def frozen_at(self, law: Law) -> RecordNoise:
        """What it is at one law, whatever the law."""
        return self if self.strain is None else RecordNoise(self.at(law))

    @property
    def carries_strain_noise(self) -> bool:
        """Whether the residual is weighed for the strain's noise."""
        return self.strain is not None or self.stress.carries_strain
