"""Laboratory units to the internal ones (MPa, s, mm, °C): the only place that knows pint.

pint is loaded at the first conversion, so that files already in MPa, s and mm never wait for it.
"""

import re
from functools import cache
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    import pint

FloatArray = NDArray[np.float64]

# What laboratories write, and what pint calls it. "C" is not the coulomb here, nor "S" the siemens.
_SPELLINGS = {
    **dict.fromkeys(["", "-", "–", "—", "1", "/", "none", "strain", "abs"], "dimensionless"),
    **dict.fromkeys(["%", "pct", "percent"], "percent"),
    **dict.fromkeys(["S", "sec", "secs", "Sec", "sec.", "seconds"], "s"),
    **dict.fromkeys(["C", "°C", "℃", "deg C", "degC", "Celsius", "celsius"], "degC"),
    **dict.fromkeys(["F", "°F", "deg F", "degF"], "degF"),
    **dict.fromkeys(["Mpa", "mpa", "MPA"], "MPa"),
    **dict.fromkeys(["kpa", "Kpa", "KPa", "KPA"], "kPa"),
    **dict.fromkeys(["gpa", "Gpa", "GPA"], "GPa"),
    **dict.fromkeys(["pa", "PA"], "Pa"),
    **dict.fromkeys(["KN", "Kn", "kn"], "kN"),
    **dict.fromkeys(["MM", "Mm"], "mm"),
}
_PLAIN_UNITS = frozenset({"s", "ms", "min", "h", "MPa", "kPa", "Pa", "GPa", "N", "kN", "mm", "cm", "m", "K"})


def convert(values: FloatArray, unit: str, target: str) -> FloatArray:
    """Convert values from a unit as a laboratory spells it.

    Parameters
    ----------
    values : ndarray, shape (n,) [unit]
    unit : str
        For example ``"kPa"``, ``"N/mm²"``, ``"%"``, ``"1/min"``, ``"s^-1"``, ``"°C"``.
    target : str
        The unit wanted, as pint spells it.

    Returns
    -------
    ndarray, shape (n,) [target]

    Raises
    ------
    ValueError
        If the unit is unknown or measures something else; the caller adds the place in the file.
    """
    spelled = spelling(unit)
    if spelled == "mPa":
        raise ValueError("unit 'mPa', millipascal")
    if spelled == target:
        return values
    if not is_unit(unit):
        raise ValueError(f"unknown unit {unit!r}")
    registry = _registry()
    if not registry.Unit(spelled).is_compatible_with(target):
        raise ValueError(f"unit {unit!r}")
    return np.asarray(registry.Quantity(values, spelled).to(target).magnitude, dtype=np.float64)


def measures(text: str, target: str) -> bool:
    """Tell whether the text spells a unit of what `target`, a unit as pint spells it, is a unit of.

    >>> measures("kN", "N"), measures("kN", "mm"), measures("Load", "N")
    (True, False, False)
    """
    try:
        convert(np.ones(1), text, target)
    except ValueError:
        return False
    return True


def is_unit(text: str) -> bool:
    """Tell whether the text spells a unit."""
    spelled = spelling(text)
    if text.strip() in _SPELLINGS or spelled in _PLAIN_UNITS:
        return True
    try:
        _registry().Unit(spelled)
    except Exception:  # pint answers nonsense with a dozen unrelated exception types
        return False
    return True


def spelling(text: str) -> str:
    """Spell a laboratory's unit as pint does: ``"N/mm2"`` becomes ``"N/mm**2"``.

    >>> spelling("s^-1"), spelling("/s"), spelling("%/min")
    ('s**-1', '1/s', 'percent/min')
    """
    text = text.strip()
    if text in _SPELLINGS:
        return _SPELLINGS[text]
    text = text.replace("²", "2").replace("³", "3").replace("⁻", "-").replace("¹", "1")
    text = text.replace("^", "**").replace("·", "*").replace("%", "percent").replace("−", "-")
    text = re.sub(r"(?<=[A-Za-z])(-?\d)", r"**\1", text)
    return f"1{text}" if text.startswith("/") else text


@cache
def _registry() -> "pint.UnitRegistry[float]":
    import pint  # noqa: PLC0415 - half a second that most files need not wait for

    return pint.UnitRegistry()
