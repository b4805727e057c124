"""Table 4: identifications on experiment 3."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation_studies.paper.grip_table import grip_table

if TYPE_CHECKING:
    from probation_studies.paper.exhibit import Exhibit, Settings


def exhibit(settings: Settings) -> Exhibit:
    """Identifications 2, 3 and 4 on experiment 3."""
    return grip_table(3, settings)
