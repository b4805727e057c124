"""What changes the relaxed stress: locking, rate, delay."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation_studies.blind.laboratory.filters import low_pass
from probation_studies.blind.laboratory.trial import Cause

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import FloatArray
    from probation_studies.blind.laboratory.trial import Setting, Shape, Trial

_NEARLY_LOCKED = 0.97


def _inverse_langevin(y: FloatArray) -> FloatArray:
    """Padé approximant of Jedynak (2015), within 0.3 %."""
    return np.asarray(y * (3.0 - 2.6 * y + 0.7 * y**2) / ((1.0 - y) * (1.0 + 0.1 * y)))


def _over_network(trial: Trial, what: FloatArray, *, at_rest: float) -> FloatArray:
    """Over the network's measure of strain; `at_rest` where that vanishes."""
    plain = trial.network
    return np.divide(what, plain, out=np.full_like(plain, at_rest), where=np.abs(plain) > 1e-9)


def _three_chains(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Chains along the three axes, N = 1 / a links: (sqrt(N) / 3) (l L^-1(l / sqrt(N)) - ...)."""
    if amplitude <= 0.0:
        return
    root = 1.0 / np.sqrt(amplitude)
    stretch = np.exp(trial.strain)

    def pull(axis: FloatArray) -> FloatArray:
        return np.asarray(root / 3.0 * axis * _inverse_langevin(np.minimum(axis / root, _NEARLY_LOCKED)))

    across = 1.0 / np.sqrt(stretch)
    small = np.array([1.0 + 1e-4])
    slope = float(((pull(small) - pull(1.0 / np.sqrt(small))) / (small**2 - 1.0 / small))[0])
    locked = (pull(stretch) - pull(across)) / slope
    trial.network_factor *= _over_network(trial, locked, at_rest=1.0)


def _warner(trial: Trial, amplitude: float, shape: Shape) -> None:
    """Finitely extensible springs along the axes: l^2 / (1 - a l^2), the springs at rest taken for 1."""
    stretch = np.exp(trial.strain)

    def pull(squared: FloatArray) -> FloatArray:
        return squared * (1.0 - amplitude) / (1.0 - np.minimum(amplitude * squared, _NEARLY_LOCKED))

    unloaded = 1.0 / (1.0 - min(amplitude, 0.5))
    locked = (pull(stretch**2) - pull(1.0 / stretch)) / unloaded
    trial.network_factor *= _over_network(trial, locked, at_rest=1.0)


def _remembered(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The network keeps ln(r / r_ref) of the last strains; what it makes of it levels off."""
    log_rate = trial.log_rate
    kept = np.empty(len(trial.time))
    kept[0] = log_rate[np.argmax(trial.strain[1:] > 1e-3)]
    fade = np.exp(-np.abs(np.diff(trial.strain)) / shape["memory_strain"])
    for m in range(len(fade)):
        kept[m + 1] = fade[m] * kept[m] + (1.0 - fade[m]) * log_rate[m]
    width = shape["width"]
    trial.network_factor *= 1.0 + amplitude * width * np.tanh(kept / width)


def _delayed(trial: Trial, amplitude: float, shape: Shape) -> None:
    """The part a of the network's stress follows through two stages one after the other."""
    whole = trial.network * trial.network_factor
    follower = whole
    for part in (shape["balance"], 1.0 - shape["balance"]):
        follower = low_pass(trial.elapsed, follower, shape["time_s"] * part)
    lagging = amplitude * (follower - whole)
    trial.network_factor = trial.network_factor + _over_network(trial, lagging, at_rest=0.0)


def _short_of_locking(setting: Setting) -> float:
    """The chains are stretched to nine tenths at most."""
    return float(0.8 * np.exp(-2.0 * setting.end_strain))


def _memory(random: Generator, setting: Setting) -> Shape:
    return {"memory_strain": random.uniform(0.03, 0.2), "width": random.uniform(4.0, 8.0)}


def _stages(random: Generator, setting: Setting) -> Shape:
    return {"time_s": setting.duration * 10.0 ** random.uniform(-2.0, -0.3), "balance": random.uniform(0.1, 0.5)}


CAUSES = (
    Cause("finite_extensibility", 0.02, lambda r, s: {}, change=_three_chains, draws=1, most=_short_of_locking),
    Cause("finite_extensibility", 0.008, lambda r, s: {}, change=_warner, draws=1, most=_short_of_locking),
    Cause("rate_dependent_hardening", 0.05, _memory, change=_remembered, signed=True, draws=2),
    Cause("delayed_hardening", 0.3, _stages, change=_delayed, draws=4),
)
