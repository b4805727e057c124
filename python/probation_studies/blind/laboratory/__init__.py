"""A virtual laboratory: campaigns whose cause is known to it alone.

It shares no code with the law, the schemes or the catalogue that it is to test, only the exceptions.
"""

from probation_studies.blind.laboratory.campaign import SealedCampaign
from probation_studies.blind.laboratory.make import SPLITS, STRATA, make
from probation_studies.blind.laboratory.truth import Truth

__all__ = ["SPLITS", "STRATA", "SealedCampaign", "Truth", "make"]
