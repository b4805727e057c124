"""Which loading histories are solved? Each stands here once, with its stress to more digits than any scheme has."""

from dataclasses import dataclass
from functools import cache

import numpy as np

from bench import reference
from bench.spectrum import Array, hardening_strain, modes

E_U, TAU_MAX, G = 3220.0, 5.2, 2.5
"""The law of the target table: [MPa], [s], [MPa]."""

RATE, END_STRAIN = 0.005, 2.0
"""Its ramp: [1/s], [-]."""

GRIP_RECORD = (-0.03445, 0.36637, 0.7055, 221.19, 224.7)
"""P2: a, b, c, d of eq. (A-1) and its duration, experiment 3's synthetic record with a tenfold range of rates."""

GRIP_LAW = (3220.0, 1.045, 1.85)
"""E_u [MPa], alpha [-], G [MPa] of that synthetic record, with eq. (11) as printed."""

COMPANION = (0.00464, 0.0367)
"""Eq. (11) as printed: We = 0.00464 log10(rate) + 0.0367."""


@dataclass(frozen=True)
class Case:
    """One history, the law it is solved with, and the stress it should give."""

    name: str
    time: Array  # [s]
    true_strain: Array
    strain_rate: Array  # [1/s], before the jump where there is one
    tau_max: Array  # [s], one entry, or one per instant
    unrelaxed_modulus: float  # [MPa]
    hardening_modulus: float  # [MPa]
    exact: Array  # [MPa]
    alpha: float | None = None  # with the companion relation, eq. (11)
    smooth: bool = True  # no jump of the rate

    @property
    def hardening(self) -> Array:
        """e_HT, known before any solve (as in an identification)."""
        return hardening_strain(self.true_strain)

    @property
    def modes(self) -> tuple[Array, Array]:
        """tau_j / tau_max and p_j."""
        return modes()

    def error(self, stress: Array) -> float:
        """Largest error [MPa]."""
        return float(np.abs(stress - self.exact).max())


@cache
def ramp(steps: int = 2000) -> Case:
    """The problem of the target table: 0.005 1/s to strain 2 in even steps."""
    return _ramp("ramp", np.linspace(0.0, END_STRAIN / RATE, steps + 1))


@cache
def uneven_ramp(steps: int = 2000) -> Case:
    """The same ramp, steps differing at random by up to 30 %."""
    step = np.random.default_rng(20).uniform(0.7, 1.3, steps)
    time = np.concatenate([[0.0], np.cumsum(step)]) * (END_STRAIN / RATE / step.sum())
    return _ramp("uneven ramp", time)


def _ramp(name: str, time: Array) -> Case:
    exact = reference.ramp(time, RATE, E_U, TAU_MAX, G)
    return Case(name, time, RATE * time, np.full_like(time, RATE), np.array([TAU_MAX]), E_U, G, exact)


@cache
def grips() -> Case:
    """A necking specimen between grips, eq. (A-1): the rate, and with it tau_max, varies tenfold."""
    time = np.linspace(0.0, GRIP_RECORD[-1], 2001)
    unrelaxed_modulus, alpha, hardening_modulus = GRIP_LAW

    def tau_max_at(t: Array) -> Array:
        return alpha * companion(_grip_rate(t))

    exact = reference.smooth(time, _grip_strain, tau_max_at, unrelaxed_modulus, hardening_modulus)
    rate = _grip_rate(time)
    return Case(
        "grips", time, _grip_strain(time), rate, tau_max_at(time), unrelaxed_modulus, hardening_modulus, exact, alpha
    )


def constant_time(case: Case) -> Case:
    """The same record with a constant tau_max: what a rate-dependent solve is compared with (its error is not)."""
    return Case(
        f"{case.name}, tau_max constant",
        case.time,
        case.true_strain,
        case.strain_rate,
        np.array([TAU_MAX]),
        case.unrelaxed_modulus,
        case.hardening_modulus,
        np.full_like(case.time, np.nan),
    )


@cache
def jump() -> Case:
    """The rate falls tenfold at strain 0.5, to strain 1; tau_max constant: closed form by superposing two ramps."""
    fast, slow, at = RATE, RATE / 10, 100.0
    time = np.linspace(0.0, 1100.0, 2201)
    before = np.minimum(time, at)
    strain = fast * before + slow * (time - before)
    rate = np.where(time <= at, fast, slow)
    exact = np.where(time <= at, reference.ramp(before, fast, E_U, TAU_MAX, G), 0.0)
    exact = np.where(time > at, _after_jump(np.maximum(time - at, 0.0), at, fast, slow), exact)
    return Case("rate jump", time, strain, rate, np.array([TAU_MAX]), E_U, G, exact, smooth=False)


def _after_jump(since: Array, at: float, fast: float, slow: float) -> Array:
    """Modal stresses at the jump decay; the second ramp adds to them, its hardening starting at strain fast * at."""
    ratio, weight = modes()
    tau = TAU_MAX * ratio
    t, at_jump = since[:, None], np.array([[at]])

    def hardening(t: Array, rate: float, strain: float) -> Array:  # int e^{-(t-s)/tau} e_HT(strain + rate s) ds / tau
        grow, fall = 2 * rate * tau + 1, -rate * tau + 1
        rising = np.exp(2 * strain) * (np.exp(2 * rate * t) - np.exp(-t / tau)) / grow
        return rising - np.exp(-strain) * (np.exp(-rate * t) - np.exp(-t / tau)) / fall

    def viscous(t: Array, rate: float) -> Array:
        return E_U * rate * tau * -np.expm1(-t / tau)

    held = viscous(at_jump, fast) + G * hardening(at_jump, fast, 0.0)
    modal = np.exp(-t / tau) * held + viscous(t, slow) + G * hardening(t, slow, fast * at)
    return modal @ weight


def companion(rate: Array) -> Array:
    """tau_max of eq. (11) [s]."""
    slope, intercept = COMPANION
    return (slope * np.log10(rate) + intercept) / rate


def _grip_strain(t: Array) -> Array:
    a, b, c, d, _ = GRIP_RECORD
    return b * t / (t**c + d * np.exp(a * t))


def _grip_rate(t: Array) -> Array:
    a, b, c, d, _ = GRIP_RECORD
    bottom = t**c + d * np.exp(a * t)
    return b * ((1 - c) * t**c + d * np.exp(a * t) * (1 - a * t)) / bottom**2
