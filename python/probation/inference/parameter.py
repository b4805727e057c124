"""One identified parameter and what is known about it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Literal, TypeVar

from probation.answers import PARAMETER_KEYS
from probation.errors import InputError
from probation.settings.certificate import CERTIFICATE

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence

Value = TypeVar("Value")

Status = Literal["identifiable", "weakly_identifiable", "not_identifiable", "held"]


UNITS = {"unrelaxed_modulus": "MPa", "tau_max": "s", "alpha": "", "hardening_modulus": "MPa"}
SYMBOLS = {"unrelaxed_modulus": "E_u", "tau_max": "τ_max", "alpha": "α", "hardening_modulus": "G"}


def status_of(relative_error: float) -> Status:
    """How well the data determine a parameter."""
    if relative_error <= CERTIFICATE.identifiable:
        return "identifiable"
    return "weakly_identifiable" if relative_error <= CERTIFICATE.weakly_identifiable else "not_identifiable"


def outside_name(name: str) -> str:
    """The name with its unit, as it leaves the program: "tau_max" becomes "tau_max_s"."""
    return PARAMETER_KEYS[name]


def symbol_of(name: str) -> str:
    """How a sentence writes a parameter: "tau_max_s" as "τ_max"; one of another law as it is called."""
    return {outside_name(own): symbol for own, symbol in SYMBOLS.items()}.get(name, name)


def by_inside_name(given: Mapping[str, Value], names: Sequence[str], argument: str) -> dict[str, Value]:
    """What is given by outside names, by their inside ones.

    Raises
    ------
    InputError
        For a name that is not among the law's parameters `names`; it names the `argument`.
    """
    inside = {outside_name(name): name for name in names}
    for name in given:
        if name not in inside:
            raise InputError(
                f"{argument}: {name!r} is not a parameter of this law; expected one of {', '.join(inside)}"
            )
    return {inside[name]: value for name, value in given.items()}


@dataclass(frozen=True)
class Parameter:
    """A parameter's estimate.

    Attributes
    ----------
    name : str
        As in `Law`.
    value : float
    se : float or None
        Standard error; None if the data do not determine the parameter, or if it is held.
    interval95 : (float, float) or None
    status : {"identifiable", "weakly_identifiable", "not_identifiable", "held"}
    unit : str
    """

    name: str
    value: float
    se: float | None
    interval95: tuple[float, float] | None
    status: Status
    unit: str

    def to_json(self) -> dict[str, object]:
        """A parameter object of docs/formats.md: value, se, interval95, status, unit."""
        interval = None if self.interval95 is None else [_number(end) for end in self.interval95]
        se = None if self.se is None else _number(self.se)
        return {
            "value": _number(self.value),
            "se": se,
            "interval95": interval,
            "status": self.status,
            "unit": self.unit,
        }


def _number(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
