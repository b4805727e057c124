"""What temperatures of the records, declared or measured, say of where a warming can come from."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from probation._arrays import running_integral
from probation.records.noise import noise_level
from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView


def all_known(views: Sequence[RecordView]) -> bool:
    """Whether every record has a temperature, declared or measured."""
    return all(view.temperature is not None for view in views)


def all_measured(views: Sequence[RecordView]) -> bool:
    """Whether every record has a column of measured temperatures."""
    return all(view.temperature_is_measured for view in views)


def starts_differ(views: Sequence[RecordView]) -> bool:
    """Whether every record has a temperature and they do not start alike."""
    starts = [float(view.temperature[0]) for view in views if view.temperature is not None]
    return len(starts) == len(views) and float(np.ptp(starts)) > EFFECTS.different_temperature


def work_can_warm(view: RecordView) -> bool:
    """Whether a measured temperature rises no further than all work, turned into heat at once, would take it.

    Cooling below the first sample's temperature, and warming without work, come from the room.
    """
    rise = view.measured_rise
    if rise is None:
        return True
    seen = view.sampled(rise)
    return bool(
        np.all(seen <= EFFECTS.largest_heating * work_so_far(view) + EFFECTS.different_temperature)
        and np.all(seen >= -EFFECTS.different_temperature)
    )


def work_so_far(view: RecordView) -> FloatArray:
    """Largest work done on the specimen so far, shape (n_samples,) [MPa]."""
    strain = view.sampled(view.true_strain)
    work = running_integral(view.data, strain)
    return np.asarray(np.maximum.accumulate(np.maximum(work, 0.0)))


def measured_against_work(view: RecordView) -> str:
    """One sentence that compares a measured rise with what the work could do; empty where nothing was measured."""
    rise = view.measured_rise
    if rise is None:
        return ""
    most = EFFECTS.usual_heating * float(work_so_far(view)[-1])
    return f"{view.id} was measured to warm by {np.max(rise):.1f} °C; all its work as heat would be {most:.1f} °C"


def warms_by_work(views: Sequence[RecordView]) -> bool:
    """Whether every record has a temperature, some rise while they are strained, and work can do it."""
    return all_known(views) and any(_rises(view) for view in views) and all(work_can_warm(view) for view in views)


def _rises(view: RecordView) -> bool:
    """Whether the measured temperature rises further than it may by what its readings scatter."""
    rise = view.measured_rise
    if rise is None or view.temperature is None:
        return False
    scatter = noise_level(view.sampled(view.time), view.temperature)
    seen = EFFECTS.rise_over_scatter * scatter / np.sqrt(len(view.temperature))
    return bool(np.max(rise) > max(seen, EFFECTS.least_rise))


def changes_without_work(views: Sequence[RecordView]) -> bool:
    """Whether every record has a temperature and some change within a record as work cannot do it."""
    return all_known(views) and not all(work_can_warm(view) for view in views)
