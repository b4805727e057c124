"""Causes in two published forms each, under the catalogue's names."""

from probation_studies.blind.laboratories.test_house.causes.flow import FLOW, RIVALS
from probation_studies.blind.laboratories.test_house.causes.form import Change, Effect, Form
from probation_studies.blind.laboratories.test_house.causes.network import NETWORK
from probation_studies.blind.laboratories.test_house.causes.rig import RIG

FORMS: dict[tuple[str, str], Form] = {(each.cause, each.name): each for each in (*FLOW, *NETWORK, *RIG)}
"""All that are drawn, by cause and name."""

CAUSES: tuple[str, ...] = tuple(sorted({each.cause for each in FORMS.values()}))

__all__ = ["CAUSES", "FORMS", "RIVALS", "Change", "Effect", "Form"]
