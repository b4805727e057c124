"""Which effects a campaign's records could show at all."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

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


def unloads(views: Sequence[RecordView]) -> bool:
    """Whether the strain is taken back anywhere, by more than its noise."""
    largest = max(float(np.max(view.largest_strain)) for view in views)
    return largest > 0.0 and any(
        float(np.max(view.largest_strain - view.true_strain)) > EFFECTS.least_return * largest for view in views
    )
