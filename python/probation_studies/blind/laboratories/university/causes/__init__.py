"""The causes of this laboratory, each from published forms."""

from probation_studies.blind.laboratories.university.causes.cause import Act, Cause, Form, Run, Setting
from probation_studies.blind.laboratories.university.causes.flow import CAUSES as FLOW
from probation_studies.blind.laboratories.university.causes.network import CAUSES as NETWORK
from probation_studies.blind.laboratories.university.causes.outside import OUTSIDE
from probation_studies.blind.laboratories.university.causes.rig import CAUSES as RIG

COMMON = (*FLOW, *NETWORK, *RIG)
"""Causes that a catalogue may hold."""

__all__ = ["COMMON", "OUTSIDE", "Act", "Cause", "Form", "Run", "Setting"]
