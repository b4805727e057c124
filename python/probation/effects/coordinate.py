"""The coordinate along which an effect's form may be wrong: what the effect follows, at every sample of a record."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np

from probation.settings.effects import EFFECTS

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

Coordinate: TypeAlias = Literal[
    "strain",
    "largest_strain",
    "strain_below_largest",
    "strain_rate",
    "time",
    "log_time",
    "force",
    "stress",
    "temperature",
    "order",
]

CoordinateHook: TypeAlias = "Callable[[RecordView, Sequence[float] | FloatArray], FloatArray]"
"""A coordinate that an effect works out itself, with its values in this record; shape (n,)."""

NEARLY = 1e-6
"""Range of a coordinate over its largest value, below which it is one value."""


def coordinate_of(
    view: RecordView, coordinate: Coordinate | CoordinateHook, values: Sequence[float] | FloatArray
) -> FloatArray:
    """A coordinate at every sample of a record, by name or of an effect with these values; shape (n_samples,)."""
    at_instants = COORDINATES[coordinate](view) if isinstance(coordinate, str) else coordinate(view, values)
    return np.asarray(view.sampled(at_instants), dtype=np.float64)


def is_one_value(low: float, high: float, coordinate: Coordinate | CoordinateHook) -> bool:
    """Whether a coordinate between these ends is one and the same value, along which no form can be wrong."""
    least = EFFECTS.least_rate_range if coordinate == "strain_rate" else 0.0
    return high - low <= max(NEARLY * max(abs(low), abs(high)), least)


def _decades(view: RecordView) -> FloatArray:
    """Decades of the rate, averaged over a small part of the record: noise of the strain is no change of the rate."""
    decades = np.clip(view.log_rate / np.log(10.0), -EFFECTS.rate_decades, EFFECTS.rate_decades)
    half = len(view) // (2 * EFFECTS.rate_window)
    window = np.full(2 * half + 1, 1.0 / (2 * half + 1))
    return np.convolve(np.pad(decades, half, mode="edge"), window, mode="valid")


def _log_time(view: RecordView) -> FloatArray:
    return np.log(np.maximum(view.elapsed, EFFECTS.first_time * view.duration))


def _temperature(view: RecordView) -> FloatArray:
    if view.temperature is None:
        return np.zeros(len(view))
    return np.interp(view.time, view.sampled(view.time), view.temperature)


COORDINATES: Mapping[Coordinate, Callable[[RecordView], FloatArray]] = {
    "strain": lambda view: view.true_strain,
    "largest_strain": lambda view: view.largest_strain,
    "strain_below_largest": lambda view: view.largest_strain - view.true_strain,
    "strain_rate": _decades,
    "time": lambda view: view.elapsed / view.duration,
    "log_time": _log_time,
    "force": lambda view: view.smooth_nominal_data,
    "stress": lambda view: view.smooth_true_data,
    "temperature": _temperature,
    "order": lambda view: np.full(len(view), float(view.index)),
}
