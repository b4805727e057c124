"""The law without companion relation on tests between grips: what its cost looks like over τ_max."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation.law.modal import Law
from probation_studies.paper.grip_tests import twin

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.histories.necking import NeckingHistory
    from probation.published.experiments import Twin
    from probation_studies.paper.grip_tests import Grip

TIMES = np.geomspace(1e-2, 300.0, 61)
"""Values of τ_max that are tried [s]."""

END_OF_JUMP = 5.0
"""The initial jump ends after so many τ_max, when even the slowest mode has relaxed to within 1 %."""


@dataclass(frozen=True, eq=False)
class CostOverTime:
    """Best fits of the law at given constant τ_max.

    Attributes
    ----------
    tau_max : ndarray, shape (n,) [s]
    unrelaxed_modulus, hardening_modulus : ndarray, shape (n,) [MPa]
        The best ones at each τ_max: the law is linear in them.
    rms : ndarray, shape (n,) [MPa]
        Of the fit residual.
    rms_fixed_product : ndarray, shape (n,) [MPa]
        With E_u τ_max kept at its value where `rms` is least, G the best one.
    """

    tau_max: FloatArray
    unrelaxed_modulus: FloatArray
    hardening_modulus: FloatArray
    rms: FloatArray
    rms_fixed_product: FloatArray

    @property
    def best(self) -> int:
        """Index of the least rms."""
        return int(np.argmin(self.rms))

    def law(self, at: int) -> Law:
        """The best law at that index."""
        return Law(
            unrelaxed_modulus=float(self.unrelaxed_modulus[at]),
            tau_max=float(self.tau_max[at]),
            hardening_modulus=float(self.hardening_modulus[at]),
        )

    def nearest_modulus(self, unrelaxed_modulus: float) -> int:
        """Index of the fit whose E_u is nearest, by ratio."""
        return int(np.argmin(np.abs(np.log(self.unrelaxed_modulus / unrelaxed_modulus))))


@lru_cache(maxsize=4)
def cost_over_time(number: Grip, seed: int = 0) -> CostOverTime:
    """Fit E_u and G at each of `TIMES` on experiment 2 or 3.

    Solved by the exact scheme, which holds whatever the ratio of step and τ_max.
    """
    test, tau_max = twin(number, seed), TIMES
    stress = test.true_stress
    instantaneous, relaxed = zip(*(_unit_responses(test, float(each)) for each in tau_max), strict=True)
    found = [
        np.linalg.lstsq(np.column_stack(pair), stress, rcond=None)[0]
        for pair in zip(instantaneous, relaxed, strict=True)
    ]
    moduli, hardening = np.array(found).T
    left = [
        e * per_modulus + g * per_hardening - stress
        for e, g, per_modulus, per_hardening in zip(moduli, hardening, instantaneous, relaxed, strict=True)
    ]
    rms = np.sqrt(np.mean(np.square(left), axis=1))
    product = float((moduli * tau_max)[np.argmin(rms)])
    kept = []
    for time, per_modulus, per_hardening in zip(tau_max, instantaneous, relaxed, strict=True):
        rest = stress - product / time * per_modulus
        kept.append(rest - (per_hardening @ rest) / (per_hardening @ per_hardening) * per_hardening)
    return CostOverTime(tau_max, moduli, hardening, rms, np.sqrt(np.mean(np.square(kept), axis=1)))


def onset(law: Law, history: NeckingHistory) -> float:
    """Stress at the end of the initial jump [MPa]: `END_OF_JUMP` times τ_max after the start."""
    assert law.tau_max is not None
    time = np.linspace(0.0, END_OF_JUMP * law.tau_max, 501)
    return float(law.stress(time, history.true_strain(time), scheme="exact")[-1])


def _unit_responses(test: Twin, tau_max: float) -> tuple[FloatArray, FloatArray]:
    """Stress per MPa of E_u and per MPa of G, each of shape (n_times,) [-]."""

    def stress(hardening_modulus: float) -> FloatArray:
        law = Law(unrelaxed_modulus=1.0, tau_max=tau_max, hardening_modulus=hardening_modulus)
        return law.stress(test.time, test.true_strain, scheme="exact")

    alone = stress(0.0)
    return alone, stress(1.0) - alone
