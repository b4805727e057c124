"""Causes in published forms, each in two or three; none is taken from a catalogue of effects."""

from probation_studies.blind.laboratories.institute.causes.beyond import BEYOND
from probation_studies.blind.laboratories.institute.causes.cause import Cause, Change, Form
from probation_studies.blind.laboratories.institute.causes.flow import FLOW
from probation_studies.blind.laboratories.institute.causes.force import FORCE
from probation_studies.blind.laboratories.institute.causes.network import NETWORK
from probation_studies.blind.laboratories.institute.causes.strain import STRAIN

COMMON = (*FLOW, *NETWORK, *FORCE, *STRAIN)

__all__ = ["BEYOND", "COMMON", "Cause", "Change", "Form"]
