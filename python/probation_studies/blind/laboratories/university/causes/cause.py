"""What a cause is: one or more published forms, each with an amplitude and a shape that is drawn."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

from probation_studies.blind.laboratories.university.modal_law import Course, Material, base_course, halved

if TYPE_CHECKING:
    from numpy.random import Generator

    from probation_studies.blind.laboratories.university.modal_law import FloatArray

Shape: TypeAlias = "Mapping[str, float]"


@dataclass(frozen=True, eq=False)
class Run:
    """One test as the specimen goes through it, on a fine, even grid.

    Attributes
    ----------
    material : Material
    time, strain : ndarray, shape (n,)
    sampling : float [s]
        Interval of the recorded samples.
    """

    material: Material
    time: FloatArray
    strain: FloatArray
    sampling: float

    @property
    def step(self) -> float:
        """Of the grid [s]."""
        return float(self.time[1] - self.time[0])

    @cached_property
    def rate(self) -> FloatArray:
        """Strain rate of every step [1/s]."""
        return np.diff(self.strain) / self.step

    @cached_property
    def largest(self) -> FloatArray:
        """Largest strain so far."""
        return np.maximum.accumulate(self.strain)

    @cached_property
    def half_strain(self) -> FloatArray:
        """Strain at the instants and between them."""
        return halved(self.strain)

    @cached_property
    def course(self) -> Course:
        """By the base law."""
        return base_course(self.material, self.time, self.strain)


@dataclass(frozen=True)
class Setting:
    """What a campaign's tests are like, so that shapes can be drawn to show in them.

    Attributes
    ----------
    rate : float [1/s]
        A middle one.
    strain, duration, sampling, flow_stress : float
        Largest strain; longest test and sampling interval [s]; a typical stress [MPa].
    time : float
        tau_max [s] at the middle rate.
    drop : float
        Strain of the unloadings; 0 without.
    """

    rate: float
    strain: float
    duration: float
    sampling: float
    flow_stress: float
    time: float
    drop: float


@dataclass(frozen=True)
class Act:
    """What a form does to a test: to the specimen's course, to its stress, to what is recorded.

    Attributes
    ----------
    course : callable, optional
    stress : callable, optional
        From the specimen's true stress to another, both [MPa].
    recorded : callable, optional
        From recorded true strain and force over the initial section [MPa] to others.
    """

    course: Callable[[Course], Course] | None = None
    stress: Callable[[FloatArray], FloatArray] | None = None
    recorded: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]] | None = None


@dataclass(frozen=True)
class Form:
    """A published form.

    Attributes
    ----------
    name : str
        Authors and year.
    draw : callable
        Its shape.
    act : callable
        From a test, an amplitude and a shape to what it does.
    """

    name: str
    draw: Callable[[Generator, Setting], dict[str, float]]
    act: Callable[[Run, float, Shape], Act]


@dataclass(frozen=True)
class Cause:
    """A cause.

    Attributes
    ----------
    name : str
        This laboratory's own.
    forms : tuple of Form
    scale, largest : float
        A usual amplitude and the largest that is used, in the unit that the forms share.
    rig : bool
        Whether it may sit in one record.
    signed : bool
        Whether the amplitude may be negative.
    needs : str
        "unloading", "rates", or nothing: what tests it shows in.
    """

    name: str
    forms: tuple[Form, ...]
    scale: float
    largest: float
    rig: bool = False
    signed: bool = False
    needs: str = ""
