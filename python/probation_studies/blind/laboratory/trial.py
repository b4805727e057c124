"""One virtual test while causes act on it: what the rig imposes, what the specimen sees, what is recorded."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from probation_studies.blind.laboratory.material import WEIGHT, BaseLaw, Specimen, integrate

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratory.material import Activation, FloatArray, Heating

Shape: TypeAlias = "dict[str, float]"
"""A cause's parameters in addition to its amplitude, with their units in their names."""

ROOM_DEGREES = 23.0
"""Temperature at which the parameters of the base law stand [°C]."""

_ITERATIONS = 60
_SETTLED = 1e-5
"""Part of the frame's strain."""


@dataclass(frozen=True)
class Setting:
    """What a cause may go by when its shape is drawn.

    Attributes
    ----------
    duration, end_strain, largest_force : float [s], [-], [MPa]
        Of the record it is confined to, or the longest, the largest and the largest of all.
    slowest, fastest : float [1/s]
        Strain rates of the campaign.
    reference_rate : float [1/s]
        Their geometric mean.
    sample : float [s]
        Between samples, of that record.
    longest_time : float [s]
        tau_max at the reference rate.
    unloads : bool
        Whether any record is unloaded.
    temperatures : bool
        Whether tests stand at several temperatures, which are recorded.
    """

    duration: float
    end_strain: float
    largest_force: float
    slowest: float
    fastest: float
    reference_rate: float
    sample: float
    longest_time: float
    unloads: bool
    temperatures: bool


@dataclass
class Trial:
    """One record of one specimen, at n instants; causes change it in place.

    Attributes
    ----------
    time, nominal : ndarray, shape (n,) [s], [-]
        The strain that the rig imposes and records.
    place : float
        Its place in the order of test, from 0 to 1.
    reference_rate : float [1/s]
    degrees : float [°C]
        Temperature of the chamber.
    strain : ndarray, shape (n,)
        The specimen's.
    log_factor, modulus_factor : ndarray, shape (n - 1,)
        Of tau_max (its logarithm) and of E_u, on each step.
    network_factor : ndarray, shape (n,)
        Of the network's stress.
    network : ndarray, shape (n,)
        Its measure of strain.
    area : ndarray, shape (n,)
        Share of the section that carries load.
    compliance : callable, optional
        Strain of the frame from the nominal stress.
    """

    law: BaseLaw
    time: FloatArray
    nominal: FloatArray
    place: float
    reference_rate: float
    degrees: float = ROOM_DEGREES
    strain: FloatArray = field(init=False)
    log_factor: FloatArray = field(init=False)
    modulus_factor: FloatArray = field(init=False)
    network_factor: FloatArray = field(init=False)
    network: FloatArray = field(init=False)
    area: FloatArray = field(init=False)
    extra: FloatArray = field(init=False)
    weight: FloatArray = field(init=False)
    overstress: FloatArray = field(init=False)
    activation: Activation | None = None
    heating: Heating | None = None
    compliance: Callable[[FloatArray], FloatArray] | None = None

    def __post_init__(self) -> None:
        n = len(self.time)
        self.strain = self.nominal.copy()
        self.log_factor, self.modulus_factor = np.zeros(n - 1), np.ones(n - 1)
        self.network_factor, self.area, self.extra = np.ones(n), np.ones(n), np.zeros(n)
        self.weight, self.overstress = WEIGHT, np.zeros_like(WEIGHT)
        self.measure()

    @property
    def elapsed(self) -> FloatArray:
        """Time since the start, shape (n,) [s]."""
        return np.asarray(self.time - self.time[0])

    @property
    def rate(self) -> FloatArray:
        """Strain rate of the specimen on each step, shape (n - 1,) [1/s]."""
        return np.asarray(np.diff(self.strain) / np.diff(self.time))

    @property
    def log_rate(self) -> FloatArray:
        """Logarithm of its size over the reference rate, shape (n - 1,)."""
        return np.asarray(np.log(np.maximum(np.abs(self.rate), 1e-12) / self.reference_rate))

    @property
    def largest(self) -> FloatArray:
        """Largest strain so far, shape (n,)."""
        return np.maximum.accumulate(self.strain)

    def measure(self) -> None:
        """Follow the specimen's strain with the network's measure of it."""
        self.network = np.exp(2.0 * self.strain) - np.exp(-self.strain)

    def specimen(self) -> Specimen:
        """What the law sees."""
        return Specimen(
            time=self.time,
            strain=self.strain,
            log_time=self.law.log_time(self.rate) + self.log_factor,
            modulus=self.law.unrelaxed_modulus * self.modulus_factor,
            relaxed=self.law.hardening_modulus * self.network_factor * self.network,
            weight=self.weight,
            overstress=self.overstress,
            extra=self.extra,
            activation=self.activation,
            heating=self.heating,
        )


def on_steps(samples: FloatArray) -> FloatArray:
    """Means over the steps between instants, shape (n - 1,)."""
    return np.asarray(0.5 * (samples[1:] + samples[:-1]))


StrainHook: TypeAlias = Callable[[Trial, float, Shape], None]
LawHook: TypeAlias = Callable[[Trial, float, Shape], None]
RecordHook: TypeAlias = "Callable[[Trial, float, Shape, FloatArray], FloatArray]"


UNKNOWN = "unknown"
"""What a cause without a name in the catalogue is called in an answer."""


@dataclass(frozen=True)
class Cause:
    """Something that the base law does not know.

    Attributes
    ----------
    name : str
        A name of the catalogue as it was when this laboratory was written, or the kind of something outside it.
    scale : float
        A usual amplitude; 0 is absence.
    draw : callable
        A shape, from a random generator and the setting.
    strain, change, record : callable, optional
        What it does to the specimen's strain, to the law, to the recorded stress.
    signed : bool
        Whether the amplitude may be negative.
    placements : tuple of {"all", "one"}
    outside : bool
        Whether it had no name there.
    known_as : str
        The name that something outside has in the catalogue since then; empty if it has none.
    localised : bool
        Whether it happens in a part of the record.
    needs_unloading : bool
    temperatures : bool, optional
        True if it needs tests at several temperatures, which are recorded. False if it needs tests in one room whose
        temperature is not: what warms the specimen would be seen, and the law would have to depend on the chamber, too.
    draws : int
        Shapes that a bank of signals needs of it.
    most : callable, optional
        Largest plausible amplitude; three usual ones if left out.
    """

    name: str
    scale: float
    draw: Callable[[Generator, Setting], Shape]
    strain: StrainHook | None = None
    change: LawHook | None = None
    record: RecordHook | None = None
    signed: bool = False
    placements: tuple[Literal["all", "one"], ...] = ("all",)
    outside: bool = False
    known_as: str = ""
    localised: bool = False
    needs_unloading: bool = False
    temperatures: bool | None = None
    draws: int = 3
    most: Callable[[Setting], float] | None = None

    @property
    def answer(self) -> str:
        """The name that an answer should give it: the catalogue's, or "unknown"."""
        return (self.known_as or UNKNOWN) if self.outside else self.name

    def largest(self, setting: Setting) -> float:
        """Largest plausible amplitude."""
        return 3.0 * self.scale if self.most is None else min(3.0 * self.scale, self.most(setting))

    def shows(self, setting: Setting) -> bool:
        """Whether there is something for it to act on, at the temperatures that it needs."""
        at_its_temperatures = self.temperatures is None or self.temperatures == setting.temperatures
        return at_its_temperatures and (setting.unloads or not self.needs_unloading)

    @property
    def solves(self) -> bool:
        """Whether the law has to be integrated anew."""
        return self.strain is not None or self.change is not None


@dataclass(frozen=True)
class Acting:
    """A cause of some amplitude and shape."""

    cause: Cause
    amplitude: float
    shape: Shape


def recorded_stress(trials: Sequence[tuple[Trial, Sequence[Acting]]]) -> list[FloatArray]:
    """Recorded true stress (n,) [MPa] of each trial under its causes; all on one time grid, each trial used once."""
    for trial, causes in trials:
        for cause in causes:
            if cause.cause.strain:
                cause.cause.strain(trial, cause.amplitude, cause.shape)
        trial.measure()
        for cause in causes:
            if cause.cause.change:
                cause.cause.change(trial, cause.amplitude, cause.shape)
    stresses = _solved([trial for trial, _ in trials])
    answers = []
    for (trial, causes), specimen_stress in zip(trials, stresses, strict=True):
        stress = specimen_stress * np.exp(trial.nominal - trial.strain)  # made with the recorded strain
        for cause in causes:
            if cause.cause.record:
                stress = cause.cause.record(trial, cause.amplitude, cause.shape, stress)
        answers.append(stress)
    return answers


def _solved(trials: Sequence[Trial]) -> list[FloatArray]:
    """True stress of the specimens; where the frame takes its part of the strain, iterated until it settles."""
    found = [
        stress * trial.area for trial, stress in zip(trials, integrate([t.specimen() for t in trials]), strict=True)
    ]
    soft = {k: trial.strain.copy() for k, trial in enumerate(trials) if trial.compliance is not None}
    for _ in range(_ITERATIONS):
        if not soft:
            break
        for k, whole in list(soft.items()):
            if _give_way(trials[k], whole, found[k]):
                del soft[k]
        for k, stress in zip(soft, integrate([trials[k].specimen() for k in soft]), strict=True):
            found[k] = stress * trials[k].area
    return found


def _give_way(trial: Trial, whole: FloatArray, stress: FloatArray) -> bool:
    """Take the frame's part off the whole strain, given the stress; True once that changes nothing."""
    assert trial.compliance is not None
    force = stress * np.exp(-trial.strain)
    frame = trial.compliance(force)
    softness = float(trial.compliance(np.ones(1))[0])
    wanted = whole + np.log1p(-np.minimum(frame * np.exp(-whole), 0.9))
    change = (wanted - trial.strain) / (1.0 + softness * trial.law.unrelaxed_modulus)
    if float(np.max(np.abs(change))) <= _SETTLED * float(np.max(np.abs(frame))):
        return True
    trial.strain = trial.strain + change
    trial.measure()
    return False
