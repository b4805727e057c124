"""A commercial testing house: few tests a series, screw-driven frames, any channel that the customer asks for.

Ramps, rate jumps, necks and small unloadings; strain and stress, or travel and force; correlated noise of the force.
Two published forms of each of 24 causes, plain and standing out from all others in both of their forms. It was written
without knowledge of the catalogue's forms.
"""

from probation_studies.blind.laboratories.test_house.handover import Made, Truth
from probation_studies.blind.laboratories.test_house.make import SPLITS, STRATA, make

__all__ = ["SPLITS", "STRATA", "Made", "Truth", "make"]
