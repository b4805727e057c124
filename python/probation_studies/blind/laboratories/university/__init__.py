"""The university's laboratory: a polymer group with a servo-hydraulic machine and a video extensometer.

Ramps at two to four rates, partial unloadings, relaxation, rate jumps and necking histories, in 3 to 9 records of 300
to 1500 samples; the errors of the strain, the first sample's too, go through the law into every covariance; in half of
the campaigns two or three specimens per programme differ by 1 to 3 % in modulus, relaxation time, hardening modulus and
section.
The extensometer's average is taken of the deviations from the command, so that it leaves the specimen's path alone.

Every cause is drawn from two published forms (`causes/`). `catalogue_names` alone knows what a catalogue calls them.
"""

from probation_studies.blind.laboratories.university.make import SPLITS, STRATA, make
from probation_studies.blind.laboratories.university.sealed import SealedCampaign, Truth

__all__ = ["SPLITS", "STRATA", "SealedCampaign", "Truth", "make"]
