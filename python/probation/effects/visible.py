"""Which effects a campaign's records could show at all."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from probation.effects.record_view import largest_strain_of
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Iterable, Sequence

    from probation.effects.effect import Effect
    from probation.effects.record_view import RecordView


def visible(effects: Iterable[Effect], views: Sequence[RecordView]) -> tuple[Effect, ...]:
    """The effects with those of their forms that these records could show; without those that have none.

    Parameters
    ----------
    views : sequence of RecordView
        Of all records that causes are sought in.
    """
    kept = (
        replace(effect, forms=forms) if len(forms) < len(effect.forms) else effect
        for effect in effects
        if (forms := tuple(form for form in effect.forms if form.visible_in(views)))
    )
    return tuple(kept)


def several(views: Sequence[RecordView]) -> bool:
    """Whether there is more than one record: what acts in all of them is another thing than what acts in one."""
    return len(views) > 1


def unloads(views: Sequence[RecordView]) -> bool:
    """Whether the strain is taken back anywhere: by a part of the largest, or by less with a good part of the force.

    A stiff specimen unloads to nothing within a hundredth of the strain that it has come to.
    """
    largest = largest_strain_of(views)
    return largest > 0.0 and any(
        float(np.max(view.largest_strain - view.true_strain)) > EFFECTS.least_return * largest or _sheds_force(view)
        for view in views
    )


def _sheds_force(view: RecordView) -> bool:
    """Whether the force falls by a good part while the strain is taken back by more than its noise."""
    back = view.largest_strain - view.true_strain > EFFECTS.return_over_noise * view.strain_noise
    if not back.any():
        return False  # its smooth force, whose splines are slow to load, has no say then
    turned = np.maximum.accumulate(np.where(view.true_strain == view.largest_strain, np.arange(len(view.time)), 0))
    force = view.smooth_nominal_data
    fall = np.where(back, force[turned] - force, 0.0)
    return float(np.max(fall)) > EFFECTS.least_fall * float(np.max(np.abs(force)))
