"""A national institute for testing materials: electromechanical frames that run for hours, a small servo-electric one.

Long-gauge clip-on extensometers or image correlation, a climate chamber, repeats in most series. Its causes come from
the literature; only `names` knows what a catalogue calls them.
"""

from probation_studies.blind.laboratories.institute.handover import Made, Truth
from probation_studies.blind.laboratories.institute.make import SPLITS, STRATA, make

__all__ = ["SPLITS", "STRATA", "Made", "Truth", "make"]
