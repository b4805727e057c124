"""A history by name: what its parameters are called, their units and defaults."""

from __future__ import annotations

import math
from dataclasses import dataclass
from difflib import get_close_matches
from typing import TYPE_CHECKING

from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable, Iterable, Mapping

    from probation.histories.imposed import ImposedHistory

Value = float | int | str


@dataclass(frozen=True)
class Parameter:
    """One number (or choice) of a named history.

    Attributes
    ----------
    unit : str
        For people; "-" for a pure number.
    default : float, int or str
        Its type is the parameter's.
    choices : tuple of str
        For a parameter that is a choice.
    least : float
        A number must be greater; a count at least that.
    """

    name: str
    unit: str
    default: Value
    meaning: str
    choices: tuple[str, ...] = ()
    least: float | None = 0.0

    def read(self, value: Value, where: str) -> Value:
        """`value`, perhaps still a text, as this parameter's type.

        Raises
        ------
        InputError
            Saying where, what was found and what was expected.
        """
        if self.choices:
            if str(value) not in self.choices:
                raise InputError(f"{where}: found {self.name}={value}, expected one of {', '.join(self.choices)}")
            return str(value)
        whole = isinstance(self.default, int)
        try:
            number = float(value)
        except ValueError:
            number = math.nan
        enough = self.least is None or number > self.least or (whole and number == self.least)
        if math.isfinite(number) and enough and (number.is_integer() or not whole):
            return int(number) if whole else number
        expected = "a whole number" if whole else f"a number in {self.unit}" if self.unit != "-" else "a number"
        bound = "" if self.least is None else f" of at least {self.least:g}" if whole else f" above {self.least:g}"
        raise InputError(f"{where}: found {self.name}={value}, expected {expected}{bound}")


@dataclass(frozen=True)
class NamedHistory:
    """A kind of test that can be asked for by name.

    Attributes
    ----------
    title : str
        What happens, in one line.
    parameters : tuple of Parameter
    make : callable
        Takes the parameters by name, returns an ImposedHistory.
    """

    name: str
    title: str
    parameters: tuple[Parameter, ...]
    make: Callable[..., ImposedHistory]

    def __call__(self, values: Mapping[str, Value]) -> ImposedHistory:
        """Make the history; parameters left out take their defaults.

        Raises
        ------
        InputError
            For an unknown parameter (suggesting the nearest) or an impossible value.
        """
        where = f"history {self.name!r}"
        known = {parameter.name: parameter for parameter in self.parameters}
        for name in values:
            if name not in known:
                raise InputError(f"{where}: found the unknown parameter {name!r}; {nearest(name, known)}")
        read = {name: parameter.read(values.get(name, parameter.default), where) for name, parameter in known.items()}
        return self.make(**read)


def nearest(name: str, known: Iterable[str]) -> str:
    """A question after the nearest known name, or the list of all."""
    known = list(known)
    close = get_close_matches(name, known, n=1)
    return f"did you mean {close[0]!r}?" if close else f"expected one of {', '.join(known)}"


def samples(default: int = 1501) -> Parameter:
    """How many instants a history has: every one has this parameter."""
    return Parameter("samples", "-", default, "instants in all", least=10)
