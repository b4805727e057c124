"""A virtual specimen: the paper's three experiments, made by the law itself in a bar that necks."""

from probation_studies.specimen.experiments import Experiment, Loading, constant_rate_point, pull
from probation_studies.specimen.recording import Recording
from probation_studies.specimen.trial import Specimen, make_specimen

__all__ = ["Experiment", "Loading", "Recording", "Specimen", "constant_rate_point", "make_specimen", "pull"]
