"""Direct predictions of the tests between grips: nothing adjusted, as in Figures 4a and 4b."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation.law.modal import Law
from probation.published.numbers import UNRELAXED_MODULUS
from probation_studies.paper.grip_tests import PUBLISHED, twin

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.law.companion import Companion
    from probation.published.experiments import NeckingSet, Twin
    from probation_studies.paper.grip_tests import Grip


@dataclass(frozen=True, eq=False)
class Prediction:
    """A synthetic record and what the law says of it.

    Attributes
    ----------
    twin : Twin
    law : Law
    model : ndarray, shape (n_times,) [MPa]
    """

    twin: Twin
    law: Law
    model: FloatArray

    @property
    def error(self) -> FloatArray:
        """Model minus data, shape (n_times,) [MPa]."""
        return self.model - self.twin.true_stress

    @property
    def largest(self) -> float:
        """Largest absolute error [MPa]."""
        return float(np.abs(self.error).max())

    @property
    def where(self) -> float:
        """True strain of the largest error [-]."""
        return float(self.twin.true_strain[np.abs(self.error).argmax()])

    @property
    def rms(self) -> float:
        """[MPa]."""
        return float(np.sqrt(np.mean(self.error**2)))


def direct_prediction(number: Grip, companion: Companion, seed: int = 0, necking: NeckingSet = "P2") -> Prediction:
    """Predict experiment 2 or 3 with E_u 3220 MPa, α 1 and the paper's regressed G (1.56 or 1.64 MPa), section 5.2."""
    test = twin(number, seed, necking)
    law = Law(
        unrelaxed_modulus=UNRELAXED_MODULUS,
        alpha=1.0,
        hardening_modulus=PUBLISHED[number].regressed_hardening,
        companion=companion,
    )
    return Prediction(test, law, law.stress(test.time, test.true_strain))
