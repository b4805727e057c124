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
        values = [self.unrelaxed_modulus, self.longest_time, self.hardening_modulus]
        values[which] *= 1.0 + relative
        return BaseLaw(*values, companion=self.companion)


@dataclass(frozen=True)
class Activation:
    """How the stress speeds up relaxation: a smoothed exponential, and a share of Ree-Eyring flow units."""

    gain: float = 0.0
    stress: float = 10.0
    share: float = 0.0
    share_stress: float = 10.0


@dataclass(frozen=True)
class Heating:
    """A slab warmed by plastic power and cooled by convection: rates and weights of its thermal eigenmodes."""

    degrees_per_work: float  # K/MPa
    rate: tuple[float, ...]  # 1/s
    weight: tuple[float, ...]
    hardening_loss: float  # 1/K


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
        Stress carried beside the spectrum.
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
    """True stress (n,) [MPa] of each; all on one time grid."""
    plain = [k for k, each in enumerate(specimens) if each.activation is None and each.heating is None]
    fed = [k for k in range(len(specimens)) if k not in set(plain)]
    stress: list[FloatArray] = [np.empty(0)] * len(specimens)
    for members, method in ((plain, _open_loop), (fed, _closed_loop)):
        if members:
            found = method([specimens[k] for k in members])
            for row, k in enumerate(members):
                stress[k] = found[row] + specimens[k].extra
    return stress


def _open_loop(specimens: list[Specimen]) -> FloatArray:
    """Relaxation times known beforehand."""
    step = np.diff(specimens[0].time)
    relaxed = np.stack([each.relaxed for each in specimens])
    drive = np.stack([each.modulus * np.diff(each.strain) for each in specimens]) - np.diff(relaxed)
    frequency = np.exp(-np.stack([each.log_time for each in specimens])) * step
    weight = np.stack([each.weight for each in specimens])
    u = np.stack([each.overstress for each in specimens])
    over = np.empty_like(relaxed)
    over[:, 0] = np.einsum("vm,vm->v", u, weight)
    block = max(1, 400_000 // u.size)
    for first in range(0, len(step), block):
        some = slice(first, first + block)
        z = frequency[:, some].T[:, :, None] / TIME_RATIO
        gain = -np.expm1(-z)
        fade = 1.0 - gain
        gain /= z
        gain *= drive[:, some].T[:, :, None]
        for m in range(len(z)):
            u = fade[m] * u + gain[m]
            over[:, first + m + 1] = np.einsum("vm,vm->v", u, weight)
    return over + relaxed


def _closed_loop(specimens: list[Specimen]) -> FloatArray:
    """Relaxation times and network follow stress and heat: every step is foretold, then taken with the mean."""
    count, n = len(specimens), len(specimens[0].time)
    step = np.diff(specimens[0].time)
    strain_step = np.stack([np.diff(each.strain) for each in specimens])
    elastic = np.stack([each.modulus for each in specimens])
    base = np.stack([each.log_time for each in specimens])
    network = np.stack([each.relaxed for each in specimens])
    extra = np.stack([each.extra for each in specimens])
    weight = np.stack([each.weight for each in specimens])
    activate = _Activations([each.activation or Activation() for each in specimens])
    heat = _Slabs([each.heating for each in specimens])
    u = np.stack([each.overstress for each in specimens])
    relaxed = network[:, 0].copy()
    stress = np.empty((count, n))
    stress[:, 0] = np.einsum("vm,vm->v", u, weight) + relaxed
    speed = activate(stress[:, 0] + extra[:, 0])
    for m in range(n - 1):
        now, then = stress[:, m] + extra[:, m], speed
        for _ in range(2):
            mean_speed = 0.5 * (speed + then) + heat.softening()
            z = (step[m] * np.exp(mean_speed - base[:, m]))[:, None] / TIME_RATIO
            gain = -np.expm1(-z)
            wanted = network[:, m + 1] * heat.hardening()
            drive = elastic[:, m] * strain_step[:, m] - (wanted - relaxed)
            moved = (1.0 - gain) * u + gain / z * drive[:, None]
            new = np.einsum("vm,vm->v", moved, weight) + wanted
            total = new + extra[:, m + 1]
            then = activate(total)
            power = 0.5 * (total + now) * (strain_step[:, m] - (total - now) / elastic[:, m])
            heat.foretell(np.maximum(power, 0.0) * _TAYLOR_QUINNEY, step[m])
        heat.keep()
        u, relaxed, speed = moved, wanted, then
        stress[:, m + 1] = new
    return stress


class _Activations:
    """Ln of the gain of flow at a stress, for all variants."""

    def __init__(self, laws: list[Activation]) -> None:
        self._gain = np.array([each.gain for each in laws])
        self._stress = np.array([each.stress for each in laws])
        self._share = np.array([each.share for each in laws])
        self._share_stress = np.array([each.share_stress for each in laws])

    def __call__(self, stress: FloatArray) -> FloatArray:
        smooth = self._gain * (np.sqrt(1.0 + (stress / self._stress) ** 2) - 1.0)
        units = np.cosh(np.minimum(np.abs(stress) / self._share_stress, 30.0)) - 1.0
        return np.asarray(smooth + np.log1p(self._share * units))


class _Slabs:
    """Mean temperatures over the ambient one, for all variants."""

    def __init__(self, slabs: list[Heating | None]) -> None:
        modes = max((len(each.rate) for each in slabs if each), default=1)
        none = Heating(0.0, (1.0,) * modes, (0.0,) * modes, 0.0)
        found = [each or none for each in slabs]
        self._rate = np.array([each.rate for each in found])
        self._source = np.array([np.multiply(each.weight, each.degrees_per_work) for each in found])
        self._loss = np.array([each.hardening_loss for each in found])
        self._modes = np.zeros_like(self._rate)
        self._next = self._modes

    def _middle(self) -> FloatArray:
        return 0.5 * (self._modes.sum(axis=1) + self._next.sum(axis=1))

    def softening(self) -> FloatArray:
        """Fall of ln tau_max by warmth, in the middle of the step."""
        warm = self._middle()
        return np.asarray(SOFTENING * warm / (1.0 + warm / REFERENCE_TEMPERATURE))

    def hardening(self) -> FloatArray:
        """Factor of the network at the end of the step."""
        return np.maximum(1.0 - self._loss * self._next.sum(axis=1), 0.1)

    def foretell(self, work: FloatArray, step: float) -> None:
        """The end of the step, given the work done in it [MPa]."""
        z = self._rate * step
        self._next = np.exp(-z) * self._modes + self._source * work[:, None] * -np.expm1(-z) / z

    def keep(self) -> None:
        """Take the step."""
        self._modes = self._next
