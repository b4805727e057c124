"""Synthetic data of the paper's three experiments, whose raw data was never published."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

import numpy as np

from probation._arrays import FloatArray, one_of
from probation.histories.necking import GRIP_SPEED, NECKING_SETS, NeckingHistory
from probation.law.companion import WEISSENBERG_AS_PRINTED
from probation.law.history import StrainHistory
from probation.law.modal import Law
from probation.law.settings import CompanionSettings, LawSettings
from probation.records.campaign import Campaign
from probation.records.record import Noise, Record
from probation.records.specimens import Specimens

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

NeckingSet = Literal["P1", "P2", "P3"]

SAMPLES = 1501
STRESS_NOISE = 0.04
"""Standard deviation of the stress noise [MPa], section 4."""

_FINER = 20  # the response is computed on so many times finer a grid: exact to 1e-5 MPa there
_UNRELAXED_MODULUS = 3220.0

RAMP_LAW = Law(unrelaxed_modulus=3224.0, tau_max=5.207, hardening_modulus=2.556)
"""What experiment 1 is made with: the reference of Table 1."""

GRIP_LAWS: dict[int, Law] = {
    2: Law(unrelaxed_modulus=3220.0, alpha=1.11, hardening_modulus=1.761, companion=WEISSENBERG_AS_PRINTED),
    3: Law(unrelaxed_modulus=3220.0, alpha=1.045, hardening_modulus=1.85, companion=WEISSENBERG_AS_PRINTED),
}
"""What experiments 2 and 3 are made with: identification 2 of Tables 3 and 4."""

_GRIP_SPEEDS = {2: 0.02, 3: 0.08}  # mm/s
_STRAIN_RATE = 0.005  # 1/s, experiment 1
_VIBRATION = 1.5e-4  # true strain
_FREQUENCIES = (0.21, 0.26, 0.33)  # Hz


@dataclass(frozen=True, eq=False)
class Twin:
    """A synthetic experiment whose truth is known.

    Attributes
    ----------
    time : ndarray, shape (n_times,) [s]
    true_strain : ndarray, shape (n_times,) [-]
        As recorded.
    true_stress : ndarray, shape (n_times,) [MPa]
        As recorded.
    strain_rate : ndarray, shape (n_times,) [1/s]
        Of the strain that the specimen saw, in closed form.
    truth : Law
        What the response was made with.
    noise_MPa : float
        Standard deviation of the stress noise.
    control : str
        As in a record.
    strain_noise : float [-]
        Standard deviation of the strain noise; the specimen did not see it.
    """

    name: str
    time: FloatArray
    true_strain: FloatArray
    true_stress: FloatArray
    strain_rate: FloatArray
    truth: Law
    noise_MPa: float  # noqa: N815 - the unit is part of the name, as in JSON
    control: str
    seed: int
    strain_noise: float = 0.0

    def record(self, role: Literal["identify", "held-out"] = "identify") -> Record:
        """The synthetic record as a laboratory would have recorded it: time, strain and stress, no rate."""
        return Record(
            id=self.name,
            time=self.time,
            true_strain=self.true_strain,
            true_stress=self.true_stress,
            control=self.control,
            role=role,
            noise=Noise(stress_MPa=self.noise_MPa, strain=self.strain_noise),
        )


def experiment_1(
    seed: int = 0, noise: float = STRESS_NOISE, *, vibration: bool = False, strain_noise: float = 0.0
) -> Twin:
    """Constant strain rate, 0.005 1/s to a true strain of 2.

    Parameters
    ----------
    noise : float [MPa]
        Standard deviation of the stress noise.
    vibration : bool
        The variant of Figure 2: the specimen vibrates by about 1.5e-4 of strain between 0.2 and 0.35 Hz, the strain
        record shows it, and so does the stress.
    strain_noise : float [-]
        Standard deviation of the noise of the strain record.
    """
    duration = 2.0 / _STRAIN_RATE
    phases = np.random.default_rng([seed, 11]).uniform(0.0, 2.0 * np.pi, len(_FREQUENCIES))
    amplitude = _VIBRATION * np.sqrt(2.0 / len(_FREQUENCIES)) if vibration else 0.0

    def strain(time: FloatArray) -> FloatArray:
        waves = sum(np.sin(2 * np.pi * f * time + p) - np.sin(p) for f, p in zip(_FREQUENCIES, phases, strict=True))
        vibrating: FloatArray = _STRAIN_RATE * time + amplitude * waves
        return vibrating

    def rate(time: FloatArray) -> FloatArray:
        waves = sum(f * np.cos(2 * np.pi * f * time + p) for f, p in zip(_FREQUENCIES, phases, strict=True))
        vibrating: FloatArray = _STRAIN_RATE + 2 * np.pi * amplitude * waves
        return vibrating

    variant = "-vibration" if vibration else ""
    return _twin(1, variant, RAMP_LAW, duration, strain, rate, "strain-rate", seed, noise, strain_noise)


def experiment_2(
    seed: int = 0, noise: float = STRESS_NOISE, *, necking: NeckingSet = "P2", strain_noise: float = 0.0
) -> Twin:
    """Grips at 0.02 mm/s: the strain rate peaks at 4.25e-3 1/s; arguments as in `experiment_3`."""
    return _grip_driven(2, seed, noise, necking, strain_noise)


def experiment_3(
    seed: int = 0, noise: float = STRESS_NOISE, *, necking: NeckingSet = "P2", strain_noise: float = 0.0
) -> Twin:
    """Grips at 0.08 mm/s: the strain rate peaks at 1.7e-2 1/s.

    Parameters
    ----------
    noise : float [MPa]
        Standard deviation of the stress noise.
    necking : {"P1", "P2", "P3"}
        Which parameters of (A-1).
    strain_noise : float [-]
        Standard deviation of the noise of the strain record.
    """
    return _grip_driven(3, seed, noise, necking, strain_noise)


def experiment(number: Literal[1, 2, 3], seed: int = 0, noise: float = STRESS_NOISE) -> Twin:
    """The synthetic record of that experiment, in its plainest variant."""
    if number == 1:
        return experiment_1(seed, noise)
    return _grip_driven(number, seed, noise, "P2", 0.0)


def necking_history(experiment: Literal[2, 3], necking: NeckingSet = "P2") -> NeckingHistory:
    """The strain history (A-1) of experiment 2 or 3."""
    history = NECKING_SETS[one_of(necking, "necking", tuple(NECKING_SETS))]
    return history.slowed(GRIP_SPEED / _GRIP_SPEEDS[experiment])


def twin_campaign(
    experiments: Sequence[Literal[1, 2, 3]] = (1,),
    *,
    seed: int = 0,
    noise: float = STRESS_NOISE,
    held_out: Sequence[Literal[1, 2, 3]] = (),
    name: str | None = None,
) -> Campaign:
    """The synthetic data as a campaign in memory.

    Experiment 1 alone asks for a constant tau_max; with 2 or 3 in it the law has the companion relation (11) as
    printed and E_u is held at 3220 MPa, as in the paper's identifications 2.

    Parameters
    ----------
    experiments : sequence of {1, 2, 3}
        Which to identify on.
    noise : float [MPa]
    held_out : sequence of {1, 2, 3}
        Which to predict only.
    name : str, optional
    """
    records = [experiment(number, seed, noise).record("identify") for number in experiments]
    records += [experiment(number, seed, noise).record("held-out") for number in held_out]
    law = LawSettings()
    if set(experiments) | set(held_out) != {1}:
        relation = CompanionSettings(
            "weissenberg",
            {"slope": WEISSENBERG_AS_PRINTED.slope, "intercept": WEISSENBERG_AS_PRINTED.intercept},
        )
        law = LawSettings(companion=relation, fixed={"unrelaxed_modulus_MPa": _UNRELAXED_MODULUS})
    default_name = "experiment-" + "-".join(str(number) for number in (*experiments, *held_out))
    return Campaign(name=name or default_name, records=tuple(records), law=law, specimens=Specimens("none"))


def _grip_driven(experiment: Literal[2, 3], seed: int, noise: float, necking: NeckingSet, strain_noise: float) -> Twin:
    history = necking_history(experiment, necking)
    return _twin(
        experiment,
        "",
        GRIP_LAWS[experiment],
        history.duration,
        history.true_strain,
        history.strain_rate,
        "displacement-rate",
        seed,
        noise,
        strain_noise,
    )


def _twin(
    experiment: int,
    variant: str,
    law: Law,
    duration: float,
    strain: Callable[[FloatArray], FloatArray],
    rate: Callable[[FloatArray], FloatArray],
    control: str,
    seed: int,
    noise: float,
    strain_noise: float,
) -> Twin:
    """Compute the response on a finer grid by the exact scheme, sample it, add noise."""
    fine = np.linspace(0.0, duration, _FINER * (SAMPLES - 1) + 1)
    seen = strain(fine)
    response = law.stress(StrainHistory(fine, seen, jumps=None), scheme="exact")
    random = np.random.default_rng([seed, experiment])
    stress = response[::_FINER] + noise * random.standard_normal(SAMPLES)
    recorded = seen[::_FINER] + strain_noise * random.standard_normal(SAMPLES)
    time = fine[::_FINER].copy()
    name = f"experiment-{experiment}{variant}"
    return Twin(name, time, recorded, stress, rate(time), law, noise, control, seed, strain_noise)
