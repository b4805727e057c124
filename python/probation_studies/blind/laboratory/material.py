"""The modal law, integrated the laboratory's own way: exact exponentials, all modes and all variants of a test at once.

With the overstress u_j = s_j / p_j - X over the relaxed stress X = G e_HT, the law is u_j' = E_u e' - X' - u_j / tau_j.
On a step on which e and X are straight and tau is constant, z_j = h / tau_j,
u_j(t + h) = e^(-z_j) u_j + (E_u De - DX) (1 - e^(-z_j)) / z_j; the stress is s = sum p_j u_j + X.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

import numpy as np
from numpy.typing import NDArray

from probation_studies.blind.laboratory.filters import BLOCK, FORGOTTEN, decaying_sum

if TYPE_CHECKING:
    from collections.abc import Sequence

FloatArray: TypeAlias = NDArray[np.float64]

MODES = 50
DECADES = 6.0
TIME_RATIO: FloatArray = 10.0 ** np.linspace(-DECADES, 0.0, MODES)
"""Relaxation times over the longest, shape (modes,)."""
WEIGHT: FloatArray = np.sqrt(TIME_RATIO) / np.sqrt(TIME_RATIO).sum()
"""Modal weights, shape (modes,)."""

REFERENCE_TEMPERATURE = 300.0  # K, of the Arrhenius law
SOFTENING = 0.1
"""Fall of ln tau_max per degree at the reference temperature [1/K]: 75 kJ/mol."""
_TAYLOR_QUINNEY = 0.9
_ITERATIONS = 100
_SETTLED_MPA = 1e-5


@dataclass(frozen=True)
class BaseLaw:
    """Parameters of the modal law; `longest_time` is tau_max [s], or alpha where there is a companion relation.

    `companion` holds slope and intercept of tau_max rate = slope log10(rate) + intercept.
    """

    unrelaxed_modulus: float
    longest_time: float
    hardening_modulus: float
    companion: tuple[float, float] | None = None

    def log_time(self, rate: FloatArray) -> FloatArray:
        """Ln tau_max at these strain rates, of the shape of `rate`."""
        if self.companion is None:
            return np.full_like(rate, np.log(self.longest_time))
        slope, intercept = self.companion
        seen = np.maximum(np.abs(rate), 1e-7)
        return np.asarray(np.log(self.longest_time * (slope * np.log10(seen) + intercept) / seen))

    def shifted(self, which: int, relative: float) -> BaseLaw:
        """The law with one parameter (0 to 2) larger by a relative amount."""
        factor = [1.0, 1.0, 1.0]
        factor[which] += relative
        return BaseLaw(
            self.unrelaxed_modulus * factor[0],
            self.longest_time * factor[1],
            self.hardening_modulus * factor[2],
            self.companion,
        )


@dataclass(frozen=True)
class Activation:
    """How the stress speeds up relaxation: a smoothed exponential, and a share of Ree-Eyring flow units."""

    gain: float = 0.0
    stress: float = 10.0
    share: float = 0.0
    share_stress: float = 10.0

    def log_gain(self, stress: FloatArray) -> FloatArray:
        """Ln of the gain of the rate of flow."""
        smooth = self.gain * (np.sqrt(1.0 + (stress / self.stress) ** 2) - 1.0)
        units = np.cosh(np.minimum(np.abs(stress) / self.share_stress, 30.0)) - 1.0
        return np.asarray(smooth + np.log1p(self.share * units))


@dataclass(frozen=True)
class Heating:
    """A slab warmed by plastic power and cooled by convection: rates and weights of its thermal eigenmodes."""

    degrees_per_work: float  # K/MPa
    rate: tuple[float, ...]  # 1/s
    weight: tuple[float, ...]
    hardening_loss: float  # 1/K

    def rise(self, specimen: Specimen, stress: FloatArray) -> FloatArray:
        """Mean temperature over that of the room, from the work that is not stored elastically; shape (n,) [K]."""
        mean = 0.5 * (stress[1:] + stress[:-1])
        work = mean * (np.diff(specimen.strain) - np.diff(stress) / specimen.modulus)
        source = self.degrees_per_work * _TAYLOR_QUINNEY * np.maximum(work, 0.0)
        warm = np.zeros(len(stress))
        for rate, weight in zip(self.rate, self.weight, strict=True):
            z = rate * np.diff(specimen.time)
            warm += weight * decaying_sum(z, source * -np.expm1(-z) / z)
        return warm


@dataclass
class Specimen:
    """What the law sees along one test, at n instants.

    Attributes
    ----------
    time, strain : ndarray, shape (n,) [s], [-]
        Of the specimen.
    log_time : ndarray, shape (n - 1,)
        Ln tau_max on each step.
    modulus : ndarray, shape (n - 1,) [MPa]
        E_u on each step.
    relaxed : ndarray, shape (n,) [MPa]
        X, the stress of the network.
    weight : ndarray, shape (modes,)
    overstress : ndarray, shape (modes,) [MPa]
        u_j at the start.
    extra : ndarray, shape (n,) [MPa]
        Stress carried in parallel with the spectrum.
    activation, heating : optional
        Feedbacks of the stress.
    """

    time: FloatArray
    strain: FloatArray
    log_time: FloatArray
    modulus: FloatArray
    relaxed: FloatArray
    weight: FloatArray
    overstress: FloatArray
    extra: FloatArray
    activation: Activation | None = None
    heating: Heating | None = None


def integrate(specimens: Sequence[Specimen]) -> list[FloatArray]:
    """True stress (n,) [MPa] of each; all on one time grid.

    Where relaxation times or network follow the stress, the whole record is solved again and again with what the last
    stress says, damped where the stress answers strongly, until nothing changes.
    """
    if not specimens:
        return []
    stress = _solved(specimens, [_Fed(each, None) for each in specimens])
    moving = [k for k, each in enumerate(specimens) if each.activation is not None or each.heating is not None]
    for _ in range(_ITERATIONS):
        if not moving:
            return stress
        fed = [_Fed(specimens[k], stress[k]) for k in moving]
        found = _solved([specimens[k] for k in moving], fed)
        still = []
        for k, each, new in zip(moving, fed, found, strict=True):
            change = (new - stress[k]) * each.damping
            stress[k] = stress[k] + change
            if float(np.max(np.abs(change))) > _SETTLED_MPA:
                still.append(k)
        moving = still
    worst = (
        max(float(np.max(np.abs(new - stress[k]))) for k, new in zip(moving, found, strict=False)) if moving else 0.0
    )
    if worst > 1e-2:
        raise RuntimeError(f"feedback of the stress: not settled after {_ITERATIONS} passes ({worst:.1e} MPa)")
    return stress


class _Fed:
    """What a stress makes of a specimen's relaxation times and network."""

    def __init__(self, specimen: Specimen, stress: FloatArray | None) -> None:
        self.log_time, self.relaxed = specimen.log_time, specimen.relaxed
        self.damping: FloatArray = np.ones(len(specimen.time))
        if stress is None:
            return
        if specimen.activation is not None:
            gain = specimen.activation.log_gain(stress)
            slope = (specimen.activation.log_gain(1.001 * stress) - gain) / 0.001
            self.log_time = self.log_time - 0.5 * (gain[1:] + gain[:-1])
            viscous = np.abs(stress - specimen.relaxed) / np.maximum(np.abs(stress), 1e-9)
            self.damping = 1.0 / (1.0 + slope * np.minimum(viscous, 1.0))
        if specimen.heating is not None:
            warm = specimen.heating.rise(specimen, stress)
            softened = SOFTENING * warm / (1.0 + warm / REFERENCE_TEMPERATURE)
            self.log_time = self.log_time - 0.5 * (softened[1:] + softened[:-1])
            self.relaxed = self.relaxed * np.maximum(1.0 - specimen.heating.hardening_loss * warm, 0.1)


def _solved(specimens: Sequence[Specimen], fed: Sequence[_Fed]) -> list[FloatArray]:
    """The law with relaxation times and network known along the whole record."""
    step = np.diff(specimens[0].time)
    relaxed = np.stack([each.relaxed for each in fed])
    modulus = np.stack([each.modulus for each in specimens])
    drive = (modulus * np.diff(np.stack([each.strain for each in specimens])) - np.diff(relaxed)).T
    reduced = (np.exp(-np.stack([each.log_time for each in fed])) * step).T
    weight = np.stack([each.weight for each in specimens])
    over = _overstress(reduced, drive, weight, np.stack([each.overstress for each in specimens]))
    return list(over.T + relaxed + np.stack([each.extra for each in specimens]))


def _overstress(reduced: FloatArray, drive: FloatArray, weight: FloatArray, start: FloatArray) -> FloatArray:
    """Sum of p_j u_j, shape (n, variants), from steps over tau_max and E_u De - DX, both (n - 1, variants).

    A block of steps at once: u_m = e^(-C_m) (u_0 + sum b_i e^(C_i)), C_m = z_1 + ... + z_m. Modes that forget within
    every step of a block are summed in closed form.
    """
    u = start.copy()
    over = np.empty((len(reduced) + 1, len(u)))
    over[0] = np.sum(u * weight, axis=1)
    steady = np.concatenate([np.zeros((len(u), 1)), np.cumsum(weight * TIME_RATIO, axis=1)], axis=1)
    for first in range(0, len(reduced), BLOCK):
        some = slice(first, first + BLOCK)
        flow = drive[some] / reduced[some]
        fast = int(np.searchsorted(TIME_RATIO, reduced[some].min() / FORGOTTEN))
        z = reduced[some][:, :, None] / TIME_RATIO[fast:]
        pushed = flow[:, :, None] * TIME_RATIO[fast:] * (1.0 - np.exp(-z))  # z > 1e-6: ten digits
        grown = np.exp(np.cumsum(np.minimum(z, FORGOTTEN), axis=0))
        pushed *= grown
        states = (u[:, fast:] + np.cumsum(pushed, axis=0)) / grown
        over[first + 1 : first + 1 + len(z)] = (
            np.einsum("tvm,vm->tv", states, weight[:, fast:]) + flow * steady[:, fast]
        )
        u[:, :fast] = flow[-1][:, None] * TIME_RATIO[:fast]
        u[:, fast:] = states[-1]
    return over
