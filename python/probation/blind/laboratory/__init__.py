"""A virtual laboratory: campaigns whose cause is known to it alone.

It shares no code with the law, the schemes or the catalogue that it is to test, only the exceptions.
"""

from probation.blind.laboratory.campaign import SealedCampaign
from probation.blind.laboratory.make import SPLITS, STRATA, make
from probation.blind.laboratory.truth import Truth

__all__ = ["SPLITS", "STRATA", "SealedCampaign", "Truth", "make"]
