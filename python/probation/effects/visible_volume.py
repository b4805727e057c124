"""What measured transverse strains say of whether the volume grew."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.records.conversions import shrinks_in_tension
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.effects.record_view import RecordView


def section_measured(views: Sequence[RecordView]) -> bool:
    """Whether every record has a transverse strain that can be that of width and thickness."""
    return all(view.transverse_strain is not None and not _shrinks(view) for view in views)


def volume_changes(views: Sequence[RecordView]) -> bool:
    """Whether every record's section was measured, and some volume is not constant."""
    return section_measured(views) and any(_most(view) > EFFECTS.different_volume for view in views)


def measured_volume(view: RecordView) -> str:
    """One sentence on the measured volume; empty where nothing was measured."""
    if view.transverse_strain is None:
        return ""
    if _shrinks(view):
        return f"the transverse strain of {view.id} says nothing of its volume: width and thickness do not shrink alike"
    return f"{view.id} was measured to change its volume by up to {100.0 * _most(view):.1f} %"


def _shrinks(view: RecordView) -> bool:
    assert view.transverse_strain is not None
    return shrinks_in_tension(view.sampled(view.recorded_strain), view.transverse_strain)


def _most(view: RecordView) -> float:
    assert view.volume_strain is not None
    return float(np.quantile(np.abs(view.volume_strain), EFFECTS.most_of_a_record))
