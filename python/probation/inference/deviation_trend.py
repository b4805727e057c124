"""Whether specimens' deviations go with the order of the tests, their rate or their temperature.

Specimens that differ do so by chance. What changes from test to test (a room that warms, a material that ages), or with
the rate (a law of another rate dependence), may be taken for scatter, where specimens may differ; but it has an order.
"""

from __future__ import annotations

from dataclasses import dataclass
from itertools import permutations
from math import factorial
from typing import TYPE_CHECKING

import numpy as np

from probation.inference.deviations import TITLES
from probation.noise.own_deviations import deviations_of
from probation.settings.detection import DETECTION
from probation.settings.effects import EFFECTS
from probation.settings.noise import NOISE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.inference.base_fit import BaseFit

_WORDS = {
    "order": ("the order of the tests", "a room that warms, a material that ages or a cell that wanders"),
    "strain_rate": ("the strain rate", "a law of another rate dependence"),
    "temperature": ("the temperature", "a law that knows no temperature"),
}
"""Of each variable its name, and what makes specimens seem to follow it."""


@dataclass(frozen=True)
class DeviationTrend:
    """What of the specimens' deviations is in an order.

    Attributes
    ----------
    deviation : str
        As `deviation_names`.
    variable : {"order", "strain_rate", "temperature"}
    correlation : float
        Over the specimens.
    p_value : float
        That any deviation goes so far with any of these variables by chance: of permutations.
    others : tuple of str
        Variables that the deviation goes with about as well: these specimens do not tell them apart.
    """

    deviation: str
    variable: str
    correlation: float
    p_value: float
    others: tuple[str, ...] = ()

    @property
    def text(self) -> str:
        """In words."""
        name, like = _WORDS[self.variable]
        what = TITLES.get(self.deviation, self.deviation)
        falls = "falls" if self.correlation < 0.0 else "grows"
        text = f"{what} {falls} with {name} (p = {self.p_value:.2g}), as with {like}"
        for other in self.others:
            name, like = _WORDS[other]
            text += f", and about as well with {name}, as with {like}"
        return text + ("; these tests do not tell which" if self.others else "")


def deviation_trend(base: BaseFit) -> DeviationTrend | None:
    """The clearest trend of the specimens' most probable deviations; None where chance makes as clear a one.

    Parameters
    ----------
    base : BaseFit
        Of specimens that may differ.
    """
    noises = base.whitened.noises
    names = [name for name, size in zip(base.scatter.names, base.scatter.deviations, strict=True) if size > 0.0]
    found = list(deviations_of(base.residual_of(base.refit), noises))
    if len(found) < DETECTION.least_specimens:
        return None
    views = [[base.view(noises[index].name) for index in members] for members, _ in found]
    # A residual is the model less the data, so that the specimens' own deviations have the other sign.
    return trend_of(-np.array([size for _, size in found]), names, _variables(views))


def trend_of(
    deviations: FloatArray, names: Sequence[str], variables: Mapping[str, FloatArray]
) -> DeviationTrend | None:
    """Of deviations of specimens, shape (n_specimens, n_deviations), with variables, of shape (n_specimens,) each."""
    ranged = {name: _standard(values) for name, values in variables.items() if np.ptp(values) > 0.0}
    varied = np.ptp(deviations, axis=0) > 0.0
    if not ranged or not varied.any():
        return None
    standard = _standard(deviations[:, varied])
    against = np.stack(list(ranged.values()), axis=1)
    count = len(deviations)
    orders = _orders(count)
    # By how far a deviation goes with a variable, in what specimens differ by: what they hardly differ in is no rival.
    size = np.std(deviations[:, varied], axis=0)
    every = np.abs(np.einsum("pik,iv->pkv", standard[orders], against) * size[:, None]).max(axis=(1, 2)) / count
    here = standard.T @ against / count
    far = np.abs(here) * size[:, None]
    at, along = np.unravel_index(int(np.argmax(far)), here.shape)
    p_value = float(np.mean(every >= far[at, along] * (1.0 - 1e-12)))
    if p_value >= DETECTION.trend_level:
        return None
    name = list(np.array(names)[varied])[at]
    left = np.maximum(1.0 - here[at] ** 2, 1e-12)
    worse = 0.5 * count * np.log(left / left[along])  # logarithm of the likelihood ratio of two lines
    others = [other for index, other in enumerate(ranged) if index != along and worse[index] < DETECTION.trend_alike]
    return DeviationTrend(str(name), list(ranged)[along], float(here[at, along]), p_value, tuple(others))


def _standard(values: FloatArray) -> FloatArray:
    """With mean 0 and standard deviation 1 over the specimens."""
    return np.asarray((values - np.mean(values, axis=0)) / np.std(values, axis=0))


def _orders(count: int) -> np.ndarray:
    """Orders of so many specimens, the given one first: all, or as many as are enough."""
    if factorial(count) <= DETECTION.most_orders:
        return np.array(list(permutations(range(count))))
    rng = np.random.default_rng(0)
    drawn = [rng.permutation(count) for _ in range(DETECTION.most_orders - 1)]
    return np.array([np.arange(count), *drawn])


def _variables(views: Sequence[Sequence[RecordView]]) -> dict[str, FloatArray]:
    """Of specimens, each with its records."""
    found = {
        "order": np.array([np.mean([view.index for view in own]) for own in views], dtype=np.float64),
    }
    rates = np.array([np.mean([np.median(view.log_rate) for view in own]) for own in views])
    if np.ptp(np.log10(np.exp(rates))) > NOISE.least_rate_range:  # else it is one rate and its noise
        found["strain_rate"] = rates
    temperatures = [[view.temperature for view in own if view.temperature is not None] for own in views]
    if all(temperatures):
        warm = np.array([np.mean([np.mean(each) for each in own]) for own in temperatures])
        if np.ptp(warm) > EFFECTS.different_temperature:
            found["temperature"] = warm
    return found
