"""The same laboratory with errors as large as laboratories have them.

Strain noise of 5e-6 to 1e-3 in every record, the first sample not exempt; in half of the campaigns specimens differ,
in half of these two or three of them are tested alike. In a quarter, and wherever the law depends on it, tests stand at
two or three temperatures, which every record states; the room drifts, and specimens heat themselves, elsewhere only.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation_studies.blind.laboratory.make import SPLITS, STRATA
from probation_studies.blind.laboratory.make import make as made

if TYPE_CHECKING:
    from probation_studies.blind.laboratory.campaign import SealedCampaign

__all__ = ["SPLITS", "STRATA", "make"]


def make(seed: int, index: int, split: str = "develop", stratum: str | None = None) -> SealedCampaign:
    """As `laboratory.make.make`."""
    return made(seed, index, split, stratum, wider=True)
