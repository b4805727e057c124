"""One identified parameter and what is known about it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Literal

from probation.answers import PARAMETER_KEYS

Status = Literal["identifiable", "weakly_identifiable", "not_identifiable", "held"]

IDENTIFIABLE, WEAKLY = 0.1, 0.5
"""Largest relative standard errors of an identifiable and of a weakly identifiable parameter."""

UNITS = {"unrelaxed_modulus": "MPa", "tau_max": "s", "alpha": "", "hardening_modulus": "MPa"}
SYMBOLS = {"unrelaxed_modulus": "E_u", "tau_max": "τ_max", "alpha": "α", "hardening_modulus": "G"}


def outside_name(name: str) -> str:
    """The name with its unit, as it leaves the program: "tau_max" becomes "tau_max_s"."""
    return PARAMETER_KEYS[name]


def inside_name(name: str) -> str | None:
    """The name within the program of "tau_max_s"; None if there is no such parameter."""
    return next((inside for inside, outside in PARAMETER_KEYS.items() if outside == name), None)


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
        """As in the contract: value, se, interval95, status."""
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
