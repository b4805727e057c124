"""What a cause is: published forms that change a test, their sizes, and where they can act."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, TypeAlias

if TYPE_CHECKING:
    from probation_studies.blind.laboratories.industry.bench import BenchTest, Scales

Shape: TypeAlias = "Mapping[str, float]"
Act: TypeAlias = "Callable[[BenchTest, float, Shape], None]"


@dataclass(frozen=True)
class Form:
    """One published form of a cause.

    Attributes
    ----------
    name : str
        Of the form, with author and year.
    act : callable
        Changes a test, given the amplitude and the other parameters.
    largest : float
        Amplitude of a gross case; a hundredth of it is small enough to be linear.
    shape : dict
        Least and largest of every other parameter; drawn evenly in the logarithm.
    signed : bool
        Whether the amplitude may be negative.
    unit : callable, optional
        From the campaign's scales to the size of an amplitude of one in its own unit.
    crosshead : bool
        Whether an extensometer on the specimen does not see it.
    """

    name: str
    act: Act
    largest: float
    shape: Mapping[str, tuple[float, float]]
    signed: bool = False
    unit: Callable[[Scales], float] | None = None
    crosshead: bool = False


@dataclass(frozen=True)
class Cause:
    """A cause of a misfit.

    Attributes
    ----------
    name : str
        This laboratory's.
    forms : tuple of Form
    rig : bool
        Whether it may sit in one record.
    needs : str
        "unloading", "hold", "corner" (more speeds than one in a test), "speeds" (more than one in the campaign),
        "order" (four tests or more), or nothing.
    """

    name: str
    forms: tuple[Form, ...]
    rig: bool = False
    needs: str = ""

    def forms_seen(self, *, clip_on: bool) -> tuple[Form, ...]:
        """Forms that the strain's instrument lets through."""
        return tuple(form for form in self.forms if not (clip_on and form.crosshead))
