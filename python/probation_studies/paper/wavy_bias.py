"""What a wavy bias of the paper's size does to the identifications of Tables 3 and 4.

The synthetic data are exact but for their noise; the paper's residuals are a wavy bias, 2.5 and 3.4 MPa at most. Here
biases of that size are drawn and identifications 2 and 4 repeated. Nothing is fitted to the paper: of the bias only
its largest residual after identification 2 is given, its shape is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import TYPE_CHECKING

import numpy as np

from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.law.modal import Law
from probation.published.numbers import UNRELAXED_MODULUS
from probation_studies.paper.grip_tests import PUBLISHED, twin

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.published.experiments import Twin
    from probation_studies.paper.grip_tests import Grip

SINES = 3
"""How many sines in the strain make a bias, of equal amplitude and random phase."""

WAVES = (0.5, 4.0)
"""How many waves each may have from start to end of the test."""

ALPHAS = np.geomspace(0.3, 3.0, 61)
"""Values of α between which the least cost is looked for."""

RISES = (0.0, 0.02, 0.1)
"""Strains over which a bias builds up from zero; 0: it is there from the start, as that of a force offset is."""

_ROUNDS = 4  # of scaling a bias to the residual it shall leave: the residual is all but linear in it


@dataclass(frozen=True)
class Estimate:
    """An identification: E_u [MPa], alpha [-], G [MPa], cost [MPa^2], residual (n_times,) [MPa]."""

    unrelaxed_modulus: float
    alpha: float
    hardening_modulus: float
    cost: float
    residual: FloatArray


@dataclass(frozen=True, eq=False)
class BiasStudy:
    """Identifications 2 and 4 under drawn biases; all of shape (draws,).

    Attributes
    ----------
    cost_2, cost_4 : ndarray [MPa^2]
    alpha_2, alpha_4 : ndarray [-]
    hardening_2, hardening_4 : ndarray [MPa]
    unrelaxed_modulus_4 : ndarray [MPa]
    example : int
        The draw whose E_u moves by the median amount, either way.
    example_stress : ndarray, shape (n_times,) [MPa]
        The synthetic record with that bias.
    example_residuals : dict of int to ndarray, shape (n_times,) [MPa]
        What identifications 2 and 4 leave of it.
    """

    cost_2: FloatArray
    cost_4: FloatArray
    alpha_2: FloatArray
    alpha_4: FloatArray
    hardening_2: FloatArray
    hardening_4: FloatArray
    unrelaxed_modulus_4: FloatArray
    example: int
    example_stress: FloatArray
    example_residuals: dict[int, FloatArray]


class ProfiledFit:
    """Identifications over a grid of α, on which the unit responses of one synthetic record are kept.

    The law is linear in E_u and G: at each α they follow from linear least squares, and the least cost from the
    parabola through the three best α.
    """

    def __init__(self, test: Twin, alphas: FloatArray = ALPHAS) -> None:
        self.log_alphas = np.log(alphas)
        self.responses = np.array([_unit_responses(test, float(alpha)) for alpha in alphas])
        self.gram = self.responses @ self.responses.transpose(0, 2, 1)

    def __call__(self, stress: FloatArray, unrelaxed_modulus: float | None = None) -> Estimate:
        """Identify alpha, G and, unless it is given, E_u."""
        correlated = self.responses @ stress
        if unrelaxed_modulus is None:
            moduli = np.linalg.solve(self.gram, correlated[..., np.newaxis])[..., 0]
        else:
            hardening = (correlated[:, 1] - unrelaxed_modulus * self.gram[:, 0, 1]) / self.gram[:, 1, 1]
            moduli = np.column_stack([np.full_like(hardening, unrelaxed_modulus), hardening])
        cost = stress @ stress + np.einsum("ak,ak->a", moduli, (self.gram @ moduli[..., np.newaxis])[..., 0])
        cost -= 2.0 * np.einsum("ak,ak->a", moduli, correlated)
        best = int(np.clip(np.argmin(cost), 1, len(cost) - 2))
        near = slice(best - 1, best + 2)
        away = self.log_alphas[near] - self.log_alphas[best]
        parabola = np.polyfit(away, cost[near], 2)
        shift = float(-0.5 * parabola[1] / parabola[0])
        left = np.einsum("akt,ak->at", self.responses[near], moduli[near]) - stress
        residual = _quadratic(away, left, shift)
        modulus, hardening_modulus = _quadratic(away, moduli[near], shift)
        return Estimate(
            float(modulus),
            float(np.exp(self.log_alphas[best] + shift)),
            float(hardening_modulus),
            float(residual @ residual),
            residual,
        )


@lru_cache(maxsize=4)
def profiled_fit(number: Grip, seed: int = 0) -> ProfiledFit:
    """Of the synthetic record of experiment 2 or 3."""
    return ProfiledFit(twin(number, seed))


@lru_cache(maxsize=16)
def bias_study(number: Grip, seed: int = 0, draws: int = 100, rise: float = 0.0) -> BiasStudy:
    """Draw biases that leave the paper's largest residual after identification 2, and identify.

    Parameters
    ----------
    number : {2, 3}
        The experiment.
    seed : int
    draws : int
        At least 1.
    rise : float [-]
        Strain over which each bias builds up, as 1 - exp(-strain / rise); 0: it is there from the start.
    """
    test, fitted = twin(number, seed), profiled_fit(number, seed)
    random = np.random.default_rng([seed, 100 + number])
    stresses, seconds, fourths = [], [], []
    for _ in range(draws):
        stresses.append(test.true_stress + _bias(test, fitted, PUBLISHED[number].largest_residual, rise, random))
        seconds.append(fitted(stresses[-1], UNRELAXED_MODULUS))
        fourths.append(fitted(stresses[-1]))
    shifts = np.abs([each.unrelaxed_modulus / UNRELAXED_MODULUS - 1.0 for each in fourths])
    example = int(np.argsort(shifts)[draws // 2])
    return BiasStudy(
        np.array([each.cost for each in seconds]),
        np.array([each.cost for each in fourths]),
        np.array([each.alpha for each in seconds]),
        np.array([each.alpha for each in fourths]),
        np.array([each.hardening_modulus for each in seconds]),
        np.array([each.hardening_modulus for each in fourths]),
        np.array([each.unrelaxed_modulus for each in fourths]),
        example,
        stresses[example],
        {2: seconds[example].residual, 4: fourths[example].residual},
    )


def middle(values: FloatArray, part: float = 0.95) -> tuple[float, float]:
    """The interval that holds the middle `part` of the values."""
    low, high = np.quantile(values, [0.5 - part / 2.0, 0.5 + part / 2.0])
    return float(low), float(high)


def drawn_wave(true_strain: FloatArray, random: np.random.Generator) -> FloatArray:
    """`SINES` sines in the strain, their waves and phases drawn; of no particular size, shape (n_times,)."""
    part = true_strain / true_strain[-1]
    waves = random.uniform(*WAVES, SINES)
    phases = random.uniform(0.0, 2.0 * np.pi, SINES)
    wave: FloatArray = np.sin(2.0 * np.pi * part[:, None] * waves + phases).sum(axis=1)
    return wave


def _bias(test: Twin, fitted: ProfiledFit, largest: float, rise: float, random: np.random.Generator) -> FloatArray:
    """A drawn bias [MPa], scaled until identification 2 leaves a largest residual of that size."""
    shape = drawn_wave(test.true_strain, random)
    if rise:
        shape *= -np.expm1(-test.true_strain / rise)
    scale = 1.0
    for _ in range(_ROUNDS):
        left = fitted(test.true_stress + scale * shape, UNRELAXED_MODULUS).residual
        scale *= largest / float(np.abs(left).max())
    return scale * shape


def _quadratic(points: FloatArray, values: FloatArray, at: float) -> FloatArray:
    """Values at three points, interpolated."""
    one, two, three = points
    weights = (
        (at - two) * (at - three) / ((one - two) * (one - three)),
        (at - one) * (at - three) / ((two - one) * (two - three)),
        (at - one) * (at - two) / ((three - one) * (three - two)),
    )
    return np.tensordot(np.array(weights), values, axes=1)


def _unit_responses(test: Twin, alpha: float) -> FloatArray:
    """Stress per MPa of E_u and of G with (11) as printed, shape (2, n_times) [-]."""

    def stress(hardening_modulus: float) -> FloatArray:
        law = Law(
            unrelaxed_modulus=1.0,
            alpha=alpha,
            hardening_modulus=hardening_modulus,
            companion=WEISSENBERG_AS_PRINTED,
        )
        return law.stress(test.time, test.true_strain, scheme="sa3")

    alone = stress(0.0)
    return np.stack([alone, stress(1.0) - alone])
