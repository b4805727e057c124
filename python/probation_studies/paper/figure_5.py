"""Figure 5: the identified law on experiment 2."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation_studies.paper.identified_figure import identified_figure

if TYPE_CHECKING:
    from probation_studies.paper.exhibit import Exhibit, Settings


def exhibit(settings: Settings) -> Exhibit:
    """Experiment 2 beside identifications 2, 3 and 4."""
    return identified_figure(5, 2, settings)
