"""From an experiment's true histories to what an experimenter has on file: samples at even instants, with noise."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.interpolate import PchipInterpolator

from probation._arrays import as_number
from probation.errors import InputError
from probation.records.record import Noise, Record

if TYPE_CHECKING:
    from probation_studies.specimen.experiments import Experiment


@dataclass(frozen=True, kw_only=True)
class Recording:
    """Sampling and noise.

    Parameters
    ----------
    samples : int
        Of each record, evenly over its time.
    stress_noise : float [MPa]
        Standard deviation; 0.04 MPa is the paper's.
    strain_noise : float [-]
        Standard deviation.
    seed : int

    Raises
    ------
    InputError
    """

    samples: int = 601
    stress_noise: float = 0.04
    strain_noise: float = 5e-5
    seed: int = 0

    def __post_init__(self) -> None:
        if self.samples < 50:
            raise InputError(f"samples are {self.samples}; at least 50 are needed")
        for name in ("stress_noise", "strain_noise"):
            if not as_number(getattr(self, name), name) >= 0.0:
                raise InputError(f"{name} is {getattr(self, name)}; a standard deviation is not negative")
        if self.seed < 0:
            raise InputError(f"seed is {self.seed}; a whole number that is not negative is needed")

    def record(self, experiment: Experiment) -> Record:
        """The record of an experiment.

        Between the increments of the finite-element run strain and stress follow monotone cubics. The noise depends on
        the seed and the experiment's name alone.
        """
        time = np.linspace(0.0, experiment.time[-1], self.samples)
        random = np.random.default_rng([self.seed, *experiment.name.encode()])
        strain = PchipInterpolator(experiment.time, experiment.true_strain)(time)
        stress = PchipInterpolator(experiment.time, experiment.true_stress)(time)
        return Record(
            id=experiment.name,
            time=time,
            true_strain=strain + self.strain_noise * random.standard_normal(self.samples),
            true_stress=stress + self.stress_noise * random.standard_normal(self.samples),
            control=experiment.control,
            noise=Noise(stress_MPa=self.stress_noise, strain=self.strain_noise),
        )
