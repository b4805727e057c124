"""What a cause is, and what its forms may change."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING, TypeAlias

import numpy as np

if TYPE_CHECKING:
    from collections.abc import Callable, Mapping, Sequence

    from numpy.random import Generator

    from probation_studies.blind.laboratories.institute.modal import Course, FloatArray
    from probation_studies.blind.laboratories.institute.series import Test

Shape: TypeAlias = "Mapping[str, float]"


@dataclass(frozen=True)
class Change:
    """What one cause does to one test; what is left out stays.

    Attributes
    ----------
    course : callable, optional
        Of the specimen's course to another.
    stress : callable, optional
        Of the true stress at the nodes [MPa] to another.
    channels : callable, optional
        Of true strain and force over the first section [MPa], at the nodes, to what the channels carry.
    warmth : callable, optional
        Without arguments: rise of the specimen's temperature at the nodes [°C], once it was strained.
    """

    course: Callable[[Course], Course] | None = None
    stress: Callable[[FloatArray], FloatArray] | None = None
    channels: Callable[[FloatArray, FloatArray], tuple[FloatArray, FloatArray]] | None = None
    warmth: Callable[[], FloatArray] | None = None


@dataclass(frozen=True)
class Form:
    """A published form of a cause.

    Attributes
    ----------
    name : str
        Authors and year.
    change : callable
        Of a test, the amplitude and the shape.
    shape : mapping
        Least and largest value of every free number of the form; drawn evenly in the logarithm.
    """

    name: str
    change: Callable[[Test, float, Shape], Change]
    shape: Mapping[str, tuple[float, float]] = field(default_factory=dict)

    def draw(self, random: Generator) -> dict[str, float]:
        """A shape."""
        return {name: float(np.exp(random.uniform(*np.log(ends)))) for name, ends in self.shape.items()}


@dataclass(frozen=True)
class Cause:
    """What may be at work.

    Attributes
    ----------
    name : str
    scale, largest : float
        A usual amplitude, and the most.
    forms : tuple of Form
    rig : bool
        Whether it may sit in one record alone.
    signed : bool
        Whether the amplitude may be negative.
    needs : str
        "cycles", "deep" ones, "temperatures", "order"; "" for nothing.
    """

    name: str
    scale: float
    largest: float
    forms: tuple[Form, ...]
    rig: bool = False
    signed: bool = False
    needs: str = ""


def shifted(values: FloatArray) -> Change:
    """ln(tau_max) shifted by values on the grid."""
    return Change(course=lambda course: replace(course, log_time=course.log_time + values))


def hardened(factor: FloatArray) -> Change:
    """Relaxed stress times a factor on the grid."""
    return Change(course=lambda course: replace(course, relaxed=course.relaxed * factor))


def scaled(factor: FloatArray) -> Change:
    """True stress times a factor on the grid."""
    return Change(stress=lambda stress: stress * factor[::2])


def maxwell(time: FloatArray, driving: FloatArray, relaxation_times: Sequence[float]) -> FloatArray:
    """Q' = d' - q/T for every T, of a driving quantity that is straight between instants; shape (n, n_times)."""
    times, found = np.asarray(relaxation_times), np.zeros((len(time), len(relaxation_times)))
    z = np.diff(time)[:, None] / times
    kept, gained = np.exp(-z), -np.expm1(-z) / z * np.diff(driving)[:, None]
    for n in range(len(z)):
        found[n + 1] = kept[n] * found[n] + gained[n]
    return found
