"""One test on the bench: what the specimen does, what the machine reads, what the base law leaves of it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from typing import TypeAlias

import numpy as np

from probation_studies.blind.laboratories.industry.memory import SQUARE_ROOT, FloatArray, Memory, haward_thackray

Flow: TypeAlias = "Callable[[FloatArray], FloatArray]"
"""From the true stress at the nodes to what is added to ln tau_max in the intervals."""

_SLOWEST = 1e-3  # of the reference rate: a hold has no rate of its own
_ROUNDS, _CLOSE = 40, 1e-6


@dataclass(frozen=True)
class Law:
    """Parameters of the base law.

    Attributes
    ----------
    modulus, hardening : float [MPa]
    time : float [s], or [-]
        tau_max; with a companion its factor alpha.
    companion : tuple of float, or None
        Slope and intercept of the Weissenberg number over log10 of the rate.
    """

    modulus: float
    time: float
    hardening: float
    companion: tuple[float, float] | None = None

    def times(self, speed: FloatArray) -> FloatArray:
        """tau_max in intervals of these rates [s]."""
        if self.companion is None:
            return np.full(len(speed), self.time)
        slope, intercept = self.companion
        return np.asarray(self.time * (slope * np.log10(speed) + intercept) / speed)


@dataclass(frozen=True)
class Scales:
    """Sizes that the forms of causes are told in, of the whole campaign.

    Attributes
    ----------
    strain, stress, force : float [-], [MPa], [MPa]
        Largest true strain, true stress, and force over the first section.
    rate : float [1/s]
        A usual rate.
    duration : float [s]
        Of a usual test.
    """

    strain: float
    stress: float
    force: float
    rate: float
    duration: float


@dataclass(frozen=True, eq=False)
class Programme:
    """What the crosshead is told, at the nodes of one test.

    Attributes
    ----------
    time : ndarray, shape (n_nodes,) [s]
    travel : ndarray, shape (n_nodes,)
        Over the gauge length.
    corners : tuple of float [s]
        Changes of the speed, the start among them.
    order : int
        Which test of the campaign it is, from 0.
    """

    time: FloatArray
    travel: FloatArray
    corners: tuple[float, ...]
    order: int

    def thinned(self, nodes: int) -> Programme:
        """With fewer nodes, corners and what follows them kept."""
        if len(self.time) <= nodes:
            return self
        some = np.linspace(0, len(self.time) - 1, nodes).round().astype(int)
        near = [int(np.searchsorted(self.time, corner)) for corner in self.corners]
        kept = np.unique([*some, *(k + step for k in near for step in (-1, 0, 1, 2, 4, 8))])
        kept = kept[(kept >= 0) & (kept < len(self.time))]
        return replace(self, time=self.time[kept], travel=self.travel[kept])


@dataclass(eq=False)
class BenchTest:
    """A test that causes change before it is run.

    Attributes
    ----------
    programme : Programme
    law : Law
    scales : Scales
    travel : ndarray
        Of the specimen itself, over its gauge length.
    modulus : ndarray, shape (n_nodes - 1,)
    relaxed : ndarray, shape (n_nodes,), or None
        Stress of the network; G eps_HT if None.
    network : list
        Factors of that stress, of the true strain.
    memory : Memory
    flow, after, force, reading : list
        Changes of ln tau_max, of the true stress, of the force's reading, and of the travel's reading (of travel and
        true force).
    before : tuple of float
        A strain that was laid on before the record begins, and for how many tau_max.
    """

    programme: Programme
    law: Law
    scales: Scales
    travel: FloatArray = field(init=False)
    modulus: FloatArray = field(init=False)
    network: list[Callable[[FloatArray], FloatArray]] = field(default_factory=list)
    memory: Memory = SQUARE_ROOT
    flow: list[Flow] = field(default_factory=list)
    after: list[Callable[[FloatArray], FloatArray]] = field(default_factory=list)
    force: list[Callable[[FloatArray], FloatArray]] = field(default_factory=list)
    reading: list[Callable[[FloatArray, FloatArray], FloatArray]] = field(default_factory=list)
    before: tuple[float, float] = (0.0, 0.0)

    def __post_init__(self) -> None:
        self.travel = self.programme.travel.copy()
        self.modulus = np.full(len(self.time) - 1, self.law.modulus)

    @property
    def time(self) -> FloatArray:
        """Of the nodes [s]."""
        return self.programme.time

    @property
    def strain(self) -> FloatArray:
        """True strain of the specimen."""
        return np.asarray(np.log1p(self.travel))

    @property
    def speed(self) -> FloatArray:
        """Absolute true strain rate in the intervals, a floor in holds [1/s]."""
        return np.asarray(np.maximum(np.abs(np.diff(self.strain) / np.diff(self.time)), _SLOWEST * self.scales.rate))

    def run(self) -> tuple[FloatArray, FloatArray]:
        """Travel and force as they are read, without noise."""
        strain = self.strain
        stress = self._stress(strain)
        for change in self.after:
            stress = change(stress)
        force = stress * np.exp(-strain)
        travel, read = self.travel, force
        for look in self.reading:
            travel = look(travel, force)
        for cell in self.force:
            read = cell(read)
        return travel, read

    def _stress(self, strain: FloatArray) -> FloatArray:
        relaxed = self.law.hardening * haward_thackray(strain)
        for factor in self.network:
            relaxed = relaxed * factor(strain)
        steps = self.modulus * np.diff(strain) - np.diff(relaxed)
        base = np.log(self.law.times(self.speed))
        shift = np.zeros(len(base))
        stress = relaxed
        for k in range(_ROUNDS):
            if self.flow and k:
                wanted = np.clip(np.sum([flow(stress) for flow in self.flow], axis=0), -8.0, 8.0)
                shift = wanted if k == 1 else 0.4 * shift + 0.6 * wanted
            reduced = np.concatenate([[0.0], np.cumsum(np.diff(self.time) * np.exp(-base - shift))])
            if not np.all(np.isfinite(reduced)):
                return np.full(len(strain), np.nan)  # a travel or a shift beyond what a specimen can have
            found = relaxed + self.memory.operator(reduced) @ steps + self._laid_on(reduced)
            change = float(np.max(np.abs(found - stress)))
            stress = found
            if not self.flow or (k > 1 and change < _CLOSE * float(np.max(np.abs(found)))):
                break
        return np.asarray(stress)

    def _laid_on(self, reduced: FloatArray) -> FloatArray:
        strain, lasting = self.before
        if strain == 0.0:
            return np.zeros(len(reduced))
        lasting = max(lasting, 1e-6)
        share = (self.memory.read(reduced + lasting) - self.memory.read(reduced)) / lasting
        return np.asarray(self.law.modulus * strain * share)


def mid(values: FloatArray) -> FloatArray:
    """From nodes to intervals."""
    return np.asarray(0.5 * (values[1:] + values[:-1]))


def base_stress(programme: Programme, law: Law, scales: Scales, travel: FloatArray) -> FloatArray:
    """True stress of the base law along a travel that was read [MPa]."""
    test = BenchTest(replace(programme, travel=travel), law, scales)
    return test._stress(test.strain)
