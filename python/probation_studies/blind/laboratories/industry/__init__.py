"""An industrial laboratory: a screw-driven machine, travel of the crosshead or a clip-on extensometer.

Causes come from the literature. It was written without knowledge of the catalogue's forms; only `causes.CATALOGUE`
says what the catalogue calls a cause.
"""

from probation_studies.blind.laboratories.industry.make import SPLITS, STRATA, make

__all__ = ["SPLITS", "STRATA", "make"]
