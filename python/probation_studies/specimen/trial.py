"""The virtual specimen on probation: experiments, campaigns, certificate, diagnosis."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal

from probation._arrays import one_of
from probation.errors import InputError
from probation.law.companion import Weissenberg
from probation.law.settings import CompanionSettings, LawSettings
from probation.records.campaign import Campaign
from probation.records.specimens import Specimens
from probation_studies.specimen.experiments import Experiment, Loading, StrainMeasure, constant_rate_point, pull

if TYPE_CHECKING:
    from probation.fe.bar import Bar
    from probation.fe.point import MaterialPoint
    from probation.law.modal import Law
    from probation_studies.specimen.recording import Recording

FirstExperiment = Literal["point", "bar"]
"""Experiment 1 in one dimension, or in the bar whose grips a video extensometer drives."""

STRAIN_RATE = 0.005
"""Of experiment 1 [1/s]; the paper's."""

GRIP_SPEEDS = {"experiment-2": 0.02, "experiment-3": 0.08}
"""[mm/s]; the paper's."""


@dataclass(frozen=True, eq=False)
class Specimen:
    """The three experiments.

    Attributes
    ----------
    law : Law
        That made them; one for all.
    bulk_modulus : float [MPa]
    experiments : tuple of Experiment
    """

    law: Law
    bulk_modulus: float
    experiments: tuple[Experiment, ...]

    def campaign(self, recording: Recording) -> Campaign:
        """What an experimenter has: all three records to identify on, and the form of the law."""
        return self._campaign("virtual-specimen", self.experiments, recording)

    def uniaxial_campaign(self, recording: Recording) -> Campaign:
        """The control: the same strains and the same noise, the stress by the law in one dimension."""
        return self._campaign("uniaxial-control", tuple(each.uniaxial() for each in self.experiments), recording)

    def _campaign(self, name: str, experiments: tuple[Experiment, ...], recording: Recording) -> Campaign:
        relation = self.law.companion
        assert isinstance(relation, Weissenberg)
        companion = CompanionSettings("weissenberg", {"slope": relation.slope, "intercept": relation.intercept})
        records = tuple(recording.record(each) for each in experiments)
        settings = LawSettings(companion=companion)
        return Campaign(name=name, records=records, law=settings, specimens=Specimens("none"))


def make_specimen(
    law: Law,
    point: MaterialPoint,
    bar: Bar,
    *,
    first: FirstExperiment = "point",
    strain: StrainMeasure = "section",
) -> Specimen:
    """Make experiments 1, 2 and 3 of the paper with one law.

    Parameters
    ----------
    law : Law
        With a Weissenberg companion relation.
    point : MaterialPoint
        Of the same law.
    bar : Bar
    first : {"point", "bar"}
        What experiment 1 is made on.
    strain : {"section", "surface"}
        How strain is measured on a bar.

    Returns
    -------
    Specimen

    Raises
    ------
    InputError
    """
    one_of(first, "first", ("point", "bar"))
    if not isinstance(law.companion, Weissenberg):
        raise InputError("law: a virtual specimen needs a Weissenberg companion relation")
    name = "experiment-1"
    if first == "point":
        one = constant_rate_point(name, point, STRAIN_RATE, bar.centre_strain, bar.largest_centre_step)
    else:
        one = pull(name, point, bar, Loading(strain_rate=STRAIN_RATE), strain)
    others = (pull(name, point, bar, Loading(grip_speed=speed), strain) for name, speed in GRIP_SPEEDS.items())
    return Specimen(law, float(point.constants[2]), (one, *others))
