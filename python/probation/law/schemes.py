"""How the law is integrated in time: one class a scheme, which holds the options of that scheme."""

from __future__ import annotations

from dataclasses import dataclass, field, fields, replace
from functools import cached_property
from math import isfinite
from typing import TYPE_CHECKING, ClassVar, Literal, TypeAlias

from probation import _core
from probation._arrays import as_number, as_whole_number, one_of
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Collection

SchemeName = Literal["be2", "sa2", "sa3", "exact", "cvode"]
SCHEMES: tuple[SchemeName, ...] = ("be2", "sa2", "sa3", "exact", "cvode")
DIFFERENTIABLE: tuple[SchemeName, ...] = ("be2", "sa2", "sa3")
"""The schemes that have sensitivities."""

Start = Literal["exponential", "backward_euler"]
STARTS: tuple[Start, ...] = ("exponential", "backward_euler")

Arguments: TypeAlias = tuple[_core.Scheme, _core.Start, float, float, int]


@dataclass(frozen=True, kw_only=True)
class Scheme:
    """A scheme with its options; one of `BE2`, `SA2`, `SA3`, `Exact` and `CVODE`.

    Attributes
    ----------
    name : str
        By which a scheme with default options is called: ``scheme="be2"`` is ``scheme=BE2()``.
    substeps : int
        Steps from sample to sample.
    start : str
        First step of be2; the others have none to choose.

    Raises
    ------
    InputError
        For an option that is not possible, by its name.
    """

    name: ClassVar[SchemeName]
    substeps: int = field(default=1, init=False, repr=False)
    start: Start = field(default="exponential", init=False, repr=False)

    def __post_init__(self) -> None:
        if as_whole_number(self.substeps, "substeps") < 1:
            raise InputError(f"substeps is {self.substeps}; at least 1 is needed")
        self.engine  # noqa: B018 - refuses what cannot be

    def __getstate__(self) -> dict[str, object]:
        return {option.name: getattr(self, option.name) for option in fields(self)}

    @cached_property
    def engine(self) -> _core.SolverOptions:
        """The options as the engine holds them."""
        return _core.SolverOptions(*self.arguments)

    @cached_property
    def arguments(self) -> Arguments:
        """The same, one by one in the engine's order."""
        return self._arguments()

    def _arguments(self) -> Arguments:
        start = getattr(_core.Start, one_of(self.start, "start", STARTS))
        return getattr(_core.Scheme, self.name), start, 1e-10, 1e-10, 200_000


@dataclass(frozen=True, kw_only=True)
class BE2(Scheme):
    """Second-order backward differences, the paper's scheme; order 2.

    Parameters
    ----------
    start : {"exponential", "backward_euler"}
        First step, and the step after a jump of the rate. The paper's is "backward_euler".
    substeps : int
        Steps from sample to sample.

    Notes
    -----
    At h = 0.5 s the paper's start errs by 0.58 MPa in experiment 1 and biases E_u by 1 %; the exponential one is exact
    for a ramp but for the bend of the hardening, and costs nothing.
    """

    name: ClassVar[SchemeName] = "be2"
    start: Start = "exponential"
    substeps: int = 1


@dataclass(frozen=True, kw_only=True)
class SA2(Scheme):
    """Exponential recursion on a strain that is linear in each step; order 2.

    Parameters
    ----------
    substeps : int
        Steps from sample to sample.
    """

    name: ClassVar[SchemeName] = "sa2"
    substeps: int = 1


@dataclass(frozen=True, kw_only=True)
class SA3(Scheme):
    """Exponential recursion on a strain that is quadratic in each step; order 3 on smooth histories.

    Of order 2 with a companion relation, unless the history has strain rates. On rough measured strain it is no better
    than `SA2`.

    Parameters
    ----------
    substeps : int
        Steps from sample to sample.
    """

    name: ClassVar[SchemeName] = "sa3"
    substeps: int = 1


@dataclass(frozen=True, kw_only=True)
class Exact(Scheme):
    """The piecewise-linear history integrated exactly, but for the quadrature of its hardening."""

    name: ClassVar[SchemeName] = "exact"


@dataclass(frozen=True, kw_only=True)
class CVODE(Scheme):
    """The piecewise-linear history integrated by CVODE of SUNDIALS with steps of its own.

    Parameters
    ----------
    relative_tolerance : float [-]
    absolute_tolerance : float [MPa]
    max_steps : int
        Between two samples.
    """

    name: ClassVar[SchemeName] = "cvode"
    relative_tolerance: float = 1e-10
    absolute_tolerance: float = 1e-10
    max_steps: int = 200_000

    def _arguments(self) -> Arguments:
        scheme, start, *_ = super()._arguments()
        tolerances = []
        for name in ("relative_tolerance", "absolute_tolerance"):
            tolerance = as_number(getattr(self, name), name)
            if not (tolerance > 0.0 and isfinite(tolerance)):
                raise InputError(f"{name} is {tolerance!r}; a positive number is needed")
            tolerances.append(tolerance)
        most = as_whole_number(self.max_steps, "max_steps")
        if most < 1:
            raise InputError(f"max_steps is {most}; at least 1 is needed")
        return scheme, start, tolerances[0], tolerances[1], most


_NAMED: dict[str, Scheme] = {kind.name: kind() for kind in (BE2, SA2, SA3, Exact, CVODE)}


def as_scheme(scheme: Scheme | SchemeName, among: Collection[SchemeName] = SCHEMES) -> Scheme:
    """The scheme that an argument named `scheme` was given: an object as it is, a name with default options.

    Raises
    ------
    InputError
        If it is neither, or has no sensitivities where they are needed: `among` is then `DIFFERENTIABLE`.
    """
    chosen = _NAMED.get(scheme) if isinstance(scheme, str) else scheme
    if not isinstance(chosen, Scheme):
        raise InputError(f"scheme is {scheme!r}; expected one of {', '.join(among)}")
    if chosen.name not in among:
        raise InputError(f"scheme is {scheme!r}; it has no sensitivities, expected one of {', '.join(among)}")
    return chosen


def at_samples(scheme: Scheme | SchemeName, among: Collection[SchemeName] = SCHEMES) -> Scheme:
    """The same where the steps of the scheme are those between the samples, or are asked for in another way.

    Raises
    ------
    InputError
        As `as_scheme`, and for a scheme with substeps.
    """
    chosen = as_scheme(scheme, among)
    if chosen.substeps != 1:
        raise InputError(
            f"scheme is {scheme!r}; expected a scheme with substeps=1: one step from sample to sample is taken here"
        )
    return chosen


def identifying(
    scheme: Scheme | SchemeName, substeps: int | Literal["auto"] = "auto"
) -> tuple[Scheme, int | Literal["auto"]]:
    """A scheme that has sensitivities, step by sample, and how many steps it takes instead of each.

    Parameters
    ----------
    scheme : Scheme or name
        An object that has substeps says how many.
    substeps : int or "auto"
        What the argument of that name was given.

    Raises
    ------
    InputError
        If the scheme has no sensitivities, or both arguments say how many, and not the same.
    """
    chosen = as_scheme(scheme, DIFFERENTIABLE)
    if chosen.substeps == 1:
        return chosen, substeps
    if substeps not in ("auto", chosen.substeps):
        raise InputError(f"scheme is {scheme!r} and substeps is {substeps!r}; expected one number of steps")
    return replace(chosen, substeps=1), chosen.substeps


def scheme_of(name: SchemeName, start: Start) -> Scheme:
    """A scheme by its name and, for be2, its first step: what a command line or an answer says of it."""
    return BE2(start=start) if name == "be2" else as_scheme(name)


def make_solver(history: _core.History, scheme: Scheme | SchemeName = "be2") -> _core.Solver:
    """The engine's solver for one history."""
    return _core.Solver(history, *at_samples(scheme).arguments)
