"""What a form of a cause is, and what it may change."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.test_house.draws import Free
    from probation_studies.blind.laboratories.test_house.modal import Feedback, FloatArray, Law
    from probation_studies.blind.laboratories.test_house.trial import Run, Test

Shape: TypeAlias = Mapping[str, float]
Changed: TypeAlias = "Callable[[Run, FloatArray], FloatArray]"

ROOM, KELVIN = 23.0, 296.0
"""Room temperature [°C], [K]."""


@dataclass(frozen=True)
class Change:
    """What a cause changes in a test; what is left out stays.

    Attributes
    ----------
    law : callable, optional
        Of the run, to the parameters that the specimen has.
    log_tau : callable, optional
        Of the run, to what is added to ln tau_max of every step.
    weights : ndarray, shape (n_modes,), optional
    feedback : callable, optional
        Of the run, to a `Feedback`.
    relaxed, stress, force, travel : callable, optional
        Of the run and the relaxed stress over G, the true stress [MPa], the force over the stated section [MPa] or the
        crosshead's strain, at fine instants, to what it becomes.
    start : ndarray, shape (n_modes,), optional
        Stresses of the modes at the start [MPa].
    compliance : tuple of float, optional
        c and q: the rig takes up c |f|^q of the travel over the gauge length, f the force over the section [MPa].
    late : float, optional
        By which the strain's channel is late [s].
    """

    law: Callable[[Run], Law] | None = None
    log_tau: Callable[[Run], FloatArray] | None = None
    weights: FloatArray | None = None
    feedback: Callable[[Run], Feedback] | None = None
    relaxed: Changed | None = None
    stress: Changed | None = None
    force: Changed | None = None
    travel: Changed | None = None
    start: FloatArray | None = None
    compliance: tuple[float, float] | None = None
    late: float | None = None


@dataclass(frozen=True)
class Form:
    """A published form of a cause.

    Attributes
    ----------
    cause, name : str
    change : callable
        Of amount, shape and test, to a `Change`.
    low, high : float
        Range of plausible amounts.
    shape : mapping
        Free numbers in addition to the amount.
    scope : {"all", "one", "either"}
        Records that it touches.
    needs : frozenset of str
        What the series must contain: "rates", "fast", "large", "unloading", "order", "temperatures".
    """

    cause: str
    name: str
    change: Callable[[float, Shape, Test], Change]
    low: float
    high: float
    shape: Mapping[str, Free] = field(default_factory=dict)
    scope: str = "all"
    needs: frozenset[str] = frozenset()

    @property
    def usual(self) -> Effect:
        """Of usual amount and shape, in all records."""
        amount = float(self.low**0.4 * self.high**0.6)
        return Effect(self, amount, {name: free.middle for name, free in self.shape.items()})

    def shares(self, records: Sequence[str]) -> dict[str | None, float]:
        """How often it is drawn in each place: a record, or None for all."""
        everywhere = {"all": 1.0, "either": 0.5, "one": 0.0}[self.scope]
        places: dict[str | None, float] = {} if self.scope == "one" else {None: everywhere}
        return places if self.scope == "all" else places | dict.fromkeys(records, (1.0 - everywhere) / len(records))

    def draw(self, random: Generator) -> dict[str, float]:
        """A shape."""
        return {name: free.draw(random) for name, free in self.shape.items()}


@dataclass(frozen=True)
class Effect:
    """A cause at work: in one record, or in all."""

    form: Form
    amount: float
    shape: Shape
    record: str | None = None

    def touches(self, test: Test) -> bool:
        """Whether it acts there."""
        return self.record in (None, test.name)

    def changes(self, test: Test) -> list[Change]:
        """What it changes there: one thing or none."""
        return [self.form.change(self.amount, self.shape, test)] if self.touches(test) else []


def largest(values: FloatArray) -> FloatArray:
    """So far."""
    return np.maximum.accumulate(values)


def mid(values: FloatArray) -> FloatArray:
    """In the middle of every step."""
    return np.asarray(0.5 * (values[1:] + values[:-1]))


def at_instants(steps: FloatArray) -> FloatArray:
    """Between the steps that meet."""
    return np.concatenate([steps[:1], mid(steps), steps[-1:]])
