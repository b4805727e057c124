"""What a gap may depend on: variables and phases of a test at every sample (docs/diagnosis-method.md, section 12)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from scipy.ndimage import uniform_filter1d

from probation.settings.remainder import REMAINDER

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView

PHASES: Mapping[str, str] = {
    "loading": "while the strain grows",
    "unloading": "on unloading only",
    "reloading": "on reloading below the largest strain so far only",
    "unloading_and_reloading": "on unloading and reloading only",
    "hold": "while the strain is held only",
}
"""In words."""


@dataclass(frozen=True, eq=False)
class Variable:
    """Something that the gap may be a function of.

    Attributes
    ----------
    name : str
        As in `depends_on` of docs/formats.md.
    title : str
        For people: "the largest strain so far".
    label : str
        Of an axis, with the unit.
    values : ndarray, shape (n_samples,)
        At every sample of the fitted records, stacked; numbers of groups for a category.
    is_category : bool
        A group has a level of its own: no function runs from one to the next.
    """

    name: str
    title: str
    label: str
    values: FloatArray
    is_category: bool = False


def variables_of(views: Sequence[RecordView], specimens: Sequence[str]) -> list[Variable]:
    """Those that take more than one value.

    Parameters
    ----------
    views : sequence of RecordView
    specimens : sequence of str
        Of which specimen each of them is.
    """
    return [
        variable
        for variable in every_variable(views, specimens)
        if np.ptp(variable.values) > REMAINDER.least_range * max(float(np.max(np.abs(variable.values))), 1e-300)
    ]


def every_variable(views: Sequence[RecordView], specimens: Sequence[str]) -> list[Variable]:
    """All that is known of these records.

    Parameters
    ----------
    views : sequence of RecordView
    specimens : sequence of str
        Of which specimen each of them is.
    """

    def stacked(of_view: Callable[[RecordView], FloatArray]) -> FloatArray:
        return np.concatenate([of_view(view) for view in views])

    def number(of_view: Callable[[RecordView], float]) -> FloatArray:
        return stacked(lambda view: np.full(len(view.data), float(of_view(view))))

    groups = list(dict.fromkeys(specimens))
    place = {view.id: groups.index(specimen) for view, specimen in zip(views, specimens, strict=True)}
    variables = [
        Variable("strain", "the strain", "true strain [–]", stacked(lambda view: view.sampled(view.true_strain))),
        Variable("strain_rate", "the strain rate", "decades of the strain rate [log₁₀ 1/s]", stacked(_decades)),
        Variable("time", "the time", "time since the start of the test [s]", stacked(lambda v: v.sampled(v.elapsed))),
        Variable(
            "largest_strain",
            "the largest strain so far",
            "largest true strain so far [–]",
            stacked(lambda view: view.sampled(view.largest_strain)),
        ),
        Variable(
            "strain_below_largest",
            "how far the strain is below its largest so far",
            "largest true strain so far less the strain [–]",
            stacked(lambda view: view.sampled(view.largest_strain - view.true_strain)),
        ),
        Variable(
            "loading_or_unloading",
            "whether the strain grows, is held or falls",
            "direction of straining (−1: unloading, 0: hold, 1: loading)",
            stacked(_direction),
            is_category=True,
        ),
        Variable("order", "the order of the tests", "test number", number(lambda view: 1.0 + view.index)),
        Variable(
            "specimen",
            "the specimen",
            "specimen number",
            number(lambda view: 1.0 + place[view.id]),
            is_category=True,
        ),
    ]
    temperatures = [view.temperature for view in views]
    if all(temperature is not None for temperature in temperatures):
        values = np.concatenate([temperature for temperature in temperatures if temperature is not None])
        variables.append(Variable("temperature", "the temperature", "temperature [°C]", values))
    return variables


def phases_of(views: Sequence[RecordView]) -> dict[str, NDArray[np.bool_]]:
    """Which samples are in which phase of their test, each of shape (n_samples,); without those that are hardly there.

    Parameters
    ----------
    views : sequence of RecordView
    """
    phases = every_phase(views, least_below(views))
    total = sum(len(view.data) for view in views)
    enough = max(REMAINDER.least_phase * total, REMAINDER.fewest_of_a_phase)
    return {name: inside for name, inside in phases.items() if enough < int(inside.sum()) < total - enough}


def least_below(views: Sequence[RecordView]) -> float:
    """Strain below the largest so far from which on a specimen is unloaded, not noisy."""
    return REMAINDER.least_below * max(float(np.max(view.true_strain)) for view in views)


def every_phase(views: Sequence[RecordView], least: float) -> dict[str, NDArray[np.bool_]]:
    """Which samples are in which phase, each of shape (n_samples,); `least` is `least_below` of the fitted records."""
    signs, below = [], []
    for view in views:
        signs.append(_direction(view))
        below.append(view.sampled(view.largest_strain - view.true_strain) > least)
    sign, reloaded = np.concatenate(signs), np.concatenate(below)
    return {
        "loading": sign > 0.0,
        "unloading": sign < 0.0,
        "reloading": (sign > 0.0) & reloaded,
        "unloading_and_reloading": reloaded,
        "hold": sign == 0.0,
    }


def _rate(view: RecordView) -> FloatArray:
    """Strain rate with its sign, averaged over a small part of the record, shape (n_samples,) [1/s]."""
    strain, time = view.sampled(view.true_strain), view.sampled(view.time)
    return np.asarray(
        uniform_filter1d(np.gradient(strain, time), max(len(time) // REMAINDER.rate_window, 1), mode="nearest")
    )


def _direction(view: RecordView) -> FloatArray:
    """1 where the strain grows, -1 where it falls, 0 where it is held; shape (n_samples,)."""
    rate = _rate(view)
    return np.where(
        np.abs(rate) > REMAINDER.least_moving_rate * float(np.max(np.abs(rate), initial=0.0)), np.sign(rate), 0.0
    )


def _decades(view: RecordView) -> FloatArray:
    """Decadic logarithm of the modulus of the strain rate, not far below the record's usual one."""
    rate = np.abs(_rate(view))
    return np.asarray(np.log10(np.maximum(rate, REMAINDER.least_moving_rate * max(float(np.max(rate)), 1e-12))))
