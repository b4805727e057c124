"""What measured transverse strains say of whether the volume grew."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.effects.record_view import RecordView

_MOST = 0.95
"""Quantile that stands for the largest value of noisy samples."""


def section_measured(views: Sequence[RecordView]) -> bool:
    """Whether every record has a transverse strain."""
    return all(view.transverse_strain is not None for view in views)


def volume_changes(views: Sequence[RecordView]) -> bool:
    """Whether every record has a transverse strain, and some a volume that is not constant."""
    return section_measured(views) and any(_most(view) > EFFECTS.different_volume for view in views)


def measured_volume(view: RecordView) -> str:
    """One sentence on the measured volume; empty where nothing was measured."""
    if view.volume_strain is None:
        return ""
    return f"{view.id} was measured to change its volume by up to {100.0 * _most(view):.1f} %"


def _most(view: RecordView) -> float:
    assert view.volume_strain is not None
    return float(np.quantile(np.abs(view.volume_strain), _MOST))
