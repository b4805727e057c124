"""An effect that a law may leave out: its parameters, its functional forms and where it enters."""

from __future__ import annotations

import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Literal, TypeAlias

import numpy as np
from scipy.special import log_ndtr, ndtr

from probation.effects.coordinate import COORDINATES, Coordinate, CoordinateHook
from probation.errors import InputError

if TYPE_CHECKING:
    from probation._arrays import FloatArray
    from probation.effects.record_view import RecordView
    from probation.law.modification import Modification

Values: TypeAlias = "Sequence[float] | FloatArray"
"""A form's parameters in their own units, in the order of `Form.parameters`."""

Kind = Literal["material", "rig"]
Placement = Literal["all", "one"]
Sharp = Literal["line", "step", "strain_period"]

ModificationHook: TypeAlias = "Callable[[RecordView, Values], Modification | None]"
StrainHook: TypeAlias = "Callable[[RecordView, Values], FloatArray]"
StressHook: TypeAlias = "Callable[[RecordView, Values, FloatArray], FloatArray]"
NeedsHook: TypeAlias = "Callable[[Sequence[RecordView]], bool]"
StartsHook: TypeAlias = "Callable[[Sequence[RecordView], Sequence[FloatArray] | None], list[tuple[float, ...]]]"

_SNAKE_CASE = re.compile(r"[a-z][a-z0-9]*(_[a-zA-Z0-9]+)*")


@dataclass(frozen=True)
class EffectParameter:
    """A parameter of an effect, its physical bounds and its prior.

    The prior is normal, cut at the bounds; `log` means that of the logarithm. A `scale` of infinity is flat.

    Attributes
    ----------
    name : str
        With its unit, as it leaves the program: "cooling_rate_per_s".
    unit : str
        Empty for a pure number.
    lower, upper : float
        Physical bounds.
    scale : float
        Standard deviation of the prior; of the natural logarithm if `log`.
    reason : str
        Why this prior, in one line.
    centre : float
        Of the prior, in the parameter's own unit; an amplitude has 0.
    log : bool
        Positive, and searched for in its logarithm.
    starts : tuple of float
        Where searches begin; the centre if left out.
    period : float
        The effect repeats itself with this period of the parameter (a phase); 0 if it does not.
    resolution : float
        Smallest difference of values that samples resolve, where the effect has an edge that moves from sample to
        sample: the misfit has a tooth at each of them, and a derivative is a difference over more than a tooth.
    """

    name: str
    unit: str
    lower: float
    upper: float
    scale: float
    reason: str
    centre: float = 0.0
    log: bool = False
    starts: tuple[float, ...] = ()
    period: float = 0.0
    resolution: float = 0.0

    def __post_init__(self) -> None:
        if not _SNAKE_CASE.fullmatch(self.name):
            raise InputError(f"effect parameter: found the name {self.name!r}, expected snake_case with its unit")
        if not self.lower <= self.centre <= self.upper or not self.lower < self.upper:
            raise InputError(
                f"{self.name}: found bounds {self.lower}, {self.upper}, expected them around {self.centre}"
            )
        if not self.scale > 0.0:
            raise InputError(f"{self.name}: found the prior scale {self.scale!r}, expected a positive number")
        if self.log and not self.lower > 0.0:
            raise InputError(f"{self.name}: found the lower bound {self.lower}, expected a positive one: log is set")
        for start in self.starts:
            if not self.lower <= start <= self.upper:
                raise InputError(f"{self.name}: found the start {start}, expected one within the bounds")

    def to_search(self, value: float) -> float:
        """The coordinate in which it is searched for: the value, or its logarithm."""
        return float(np.log(value)) if self.log else float(value)

    def from_search(self, coordinate: float) -> float:
        """The value of a search coordinate."""
        return float(np.exp(coordinate)) if self.log else float(coordinate)

    def inside(self, value: float) -> float:
        """A value, or the bound that it is beyond."""
        return float(min(max(value, self.lower), self.upper))

    def step(self, value: float) -> float:
        """Step of a difference quotient around a value: small against the prior, large against rounding."""
        if self.log:
            return 1e-5 * value
        smooth = 1e-4 * self.scale if np.isfinite(self.scale) else 1e-5 * (self.upper - self.lower)
        return max(smooth, self.resolution)

    def log_prior(self, value: float) -> float:
        """Log density of the prior in the search coordinate, -inf outside the bounds."""
        if not self.lower <= value <= self.upper:
            return -np.inf
        low, high = self.to_search(self.lower), self.to_search(self.upper)
        if not np.isfinite(self.scale):
            return -float(np.log(self.period or high - low))
        centre = self.to_search(self.centre)
        a, b = (low - centre) / self.scale, (high - centre) / self.scale
        inside = float(ndtr(b) - ndtr(a)) if a < 0.0 < b else float(np.exp(log_ndtr(-abs(a))))
        z = (self.to_search(value) - centre) / self.scale
        return float(-0.5 * z * z - 0.5 * np.log(2.0 * np.pi) - np.log(self.scale) - np.log(inside))


@dataclass(frozen=True)
class Form:
    """One functional form of an effect, and the hooks by which it enters; a hook left out changes nothing.

    Attributes
    ----------
    name : str
        Of the form: "gent".
    parameters : tuple of EffectParameter
        The first is the amplitude, 0 where the effect is absent; the others are nonlinear parameters.
    modification : callable, optional
        ``modification(view, values)``: what changes in the law along a record, an `Modification` (or None).
    driving_strain : callable, optional
        ``driving_strain(view, values)``: the true strain that the specimen saw, shape (n,), given what was recorded.
    recorded_stress : callable, optional
        ``recorded_stress(view, values, stress)``: the true stress that was recorded, shape (n,), where the specimen's
        was `stress`.
    converts : bool
        With `driving_strain`: the recorded true stress was made of the force and the recorded strain, so that it is
        e^(recorded - seen) times the specimen's.
    own_force : bool
        With `driving_strain`: the force that it takes from the view (`nominal_data`) is to be the model's own, not the
        recorded one, whose noise would become a strain of the specimen.
    hidden_by : str, optional
        Gross faults of one name hide each other: what one does alone is far from what it does jointly with the other,
        so that they are begun jointly, too.
    placements : tuple of {"all", "one"}
        Whether the fault may sit in all records with one amplitude, in a single one, or either. Empty: all for a
        material's effect, either for a rig's.
    starts : callable, optional
        ``starts(views, residuals)``: nonlinear parameters where searches begin, from the records it is to sit in and,
        if there are any, the fit residuals (model - data) left there. Left out: the grid of `parameters`.
    threshold : bool
        The effect sets in beyond some amplitude, so that its derivative at 0 says nothing: `starts` gives the
        amplitude first, then the nonlinear parameters, and screens take the secant.
    sharp : {"line", "step", "strain_period"}, optional
        The effect shows as a line of one frequency, a step at one instant or with one period in the strain, and is only
        sought in records that have one: among all frequencies, instants or periods chance always finds something.
    needs : callable, optional
        ``needs(views)``: whether records like these could show it at all, such as an unloading; left out: any could.
        Where none of an effect's forms could be seen, the effect is not considered, and costs no probability.
    several : bool
        Whether it may act in several records, in each with nonlinear parameters of its own; not where one of
        these is the material's.
    variant : bool
        A further form, tried where there is a gap. The test for one goes without it: what it looks for is found along
        the effect's other forms and along smooth waves, and more directions would be found in more noise.
    """

    name: str
    parameters: tuple[EffectParameter, ...]
    modification: ModificationHook | None = None
    driving_strain: StrainHook | None = None
    recorded_stress: StressHook | None = None
    converts: bool = True
    own_force: bool = False
    hidden_by: str | None = None
    placements: tuple[Placement, ...] = ()
    starts: StartsHook | None = None
    threshold: bool = False
    sharp: Sharp | None = None
    needs: NeedsHook | None = None
    several: bool = True
    variant: bool = False

    def __post_init__(self) -> None:
        if not self.parameters:
            raise InputError(f"form {self.name!r}: found no parameters, expected an amplitude at least")
        amplitude = self.parameters[0]
        if amplitude.log or not amplitude.lower <= 0.0 <= amplitude.upper or amplitude.centre != 0.0:
            raise InputError(f"form {self.name!r}: the amplitude {amplitude.name} must have a prior around 0, not log")
        names = [parameter.name for parameter in self.parameters]
        if len(set(names)) < len(names):
            raise InputError(f"form {self.name!r}: found a parameter twice among {', '.join(names)}")
        if self.modification is None and self.driving_strain is None and self.recorded_stress is None:
            raise InputError(
                f"form {self.name!r}: found no hook, expected modification, driving_strain or recorded_stress"
            )
        if self.threshold and self.starts is None:
            raise InputError(f"form {self.name!r}: a threshold needs starts that give the amplitude")

    @property
    def amplitude(self) -> EffectParameter:
        """The first parameter."""
        return self.parameters[0]

    @property
    def typical(self) -> tuple[float, ...]:
        """Values of an effect of usual size: the amplitude's prior scale, the first starts of the nonlinear ones."""
        amplitude = self.amplitude
        size = amplitude.scale if np.isfinite(amplitude.scale) else amplitude.upper
        nonlinear = (parameter.starts[0] if parameter.starts else parameter.centre for parameter in self.parameters[1:])
        return (min(size, amplitude.upper), *nonlinear)

    def measured_section(self) -> Form:
        """The same where the true stress was not made with the recorded strain, but with a section measured apart."""
        return replace(self, name=f"{self.name}_measured_section", converts=False, variant=True)

    @property
    def needs_solve(self) -> bool:
        """Whether the law has to be solved anew when a parameter changes."""
        return self.modification is not None or self.driving_strain is not None

    def visible_in(self, views: Sequence[RecordView]) -> bool:
        """Whether records like these could show it at all."""
        return self.needs is None or self.needs(views)

    def nonlinear_starts(
        self, views: Sequence[RecordView], residuals: Sequence[FloatArray] | None = None
    ) -> list[tuple[float, ...]]:
        """Where searches begin: the nonlinear parameters in their order; for a threshold the amplitude in front."""
        if self.starts is not None:
            return self.starts(views, residuals)
        grid: list[tuple[float, ...]] = [()]
        for parameter in self.parameters[1:]:
            grid = [(*point, value) for point in grid for value in parameter.starts or (parameter.centre,)]
        return grid


@dataclass(frozen=True)
class Effect:
    """A cause of a gap between simulation and reality.

    Attributes
    ----------
    name : str
        snake_case.
    title : str
        For people: "self-heating".
    physics : str
        What happens, in two lines.
    source : str
        Where it is described.
    shows_in : str
        Which records can show it.
    kind : {"material", "rig"}
        A material's effect touches every record with one amplitude; a rig's fault may sit in one.
    forms : tuple of Form
        Functional forms that count as one cause.
    odds : float
        Of this effect beforehand, over those of a usual one: below 1 for what is rare.
    coordinate : str or callable
        What the effect follows, a name of `coordinate.COORDINATES` or ``coordinate(view, values)``, shape (n,): its
        form may be wrong along it. The strain, if left out.
    """

    name: str
    title: str
    physics: str
    source: str
    shows_in: str
    kind: Kind
    forms: tuple[Form, ...]
    odds: float = 1.0
    coordinate: Coordinate | CoordinateHook = "strain"

    def __post_init__(self) -> None:
        if not _SNAKE_CASE.fullmatch(self.name):
            raise InputError(f"effect: found the name {self.name!r}, expected snake_case")
        if self.kind not in ("material", "rig"):
            raise InputError(f"effect {self.name}: found the kind {self.kind!r}, expected 'material' or 'rig'")
        if not callable(self.coordinate) and self.coordinate not in COORDINATES:
            raise InputError(
                f"effect {self.name}: found the coordinate {self.coordinate!r}, expected one of "
                + ", ".join(COORDINATES)
            )
        names = [form.name for form in self.forms]
        if not names or len(set(names)) < len(names):
            raise InputError(f"effect {self.name}: found the forms {names}, expected one or more, each once")
        if not 0.0 < self.odds <= 1.0:
            raise InputError(f"effect {self.name}: found the odds {self.odds!r}, expected a number above 0, at most 1")

    def form(self, name: str) -> Form:
        """The form of that name.

        Raises
        ------
        InputError
            If there is none.
        """
        for form in self.forms:
            if form.name == name:
                return form
        raise InputError(f"effect {self.name}: found no form {name!r}; it has {', '.join(f.name for f in self.forms)}")

    def placements(self, form: Form) -> tuple[Placement, ...]:
        """Where that form may sit."""
        return form.placements or (("all",) if self.kind == "material" else ("one", "all"))
