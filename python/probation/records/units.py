"""Laboratory units to the internal ones (MPa, s, mm, °C), by a closed grammar.

A unit is a product or quotient of known symbols, each with at most one prefix and an exponent of one digit::

    unit     = ["1"] "/" factor {operator factor}  |  factor {operator factor}
    operator = "*" | "·" | " " | "/" | "per"
    factor   = [prefix] symbol [["^" | "**"] ["+" | "-"] digit]

Nothing else is evaluated, whatever a heading holds. Every factor is exact: a fraction of whole numbers.
"""

import re
from collections import Counter
from dataclasses import dataclass, field
from fractions import Fraction
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted
from probation.limits import UNIT_CHARACTERS

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Unit:
    """A unit in terms of m, kg, s, K and A.

    Attributes
    ----------
    factor : Fraction
        Size in those units.
    powers : dict of str to int
        Exponent of each of them; those of zero are left out.
    offset : Fraction [K]
        Absolute temperature at zero of the scale; not zero for °C and °F alone.
    """

    factor: Fraction
    powers: dict[str, int] = field(default_factory=dict)
    offset: Fraction = Fraction(0)


def _unit(factor: Fraction | float | str, **powers: int) -> Unit:
    return Unit(Fraction(factor), powers)


_POUND_FORCE = Fraction("4.4482216152605")  # N, exact by definition
_INCH = Fraction("0.0254")  # m, exact by definition
_PSI = _POUND_FORCE / _INCH**2
_NO_DIMENSION = _unit(1)

_PREFIXES = {
    **{"n": Fraction(1, 10**9), "u": Fraction(1, 10**6), "µ": Fraction(1, 10**6), "μ": Fraction(1, 10**6)},
    **{"m": Fraction(1, 1000), "c": Fraction(1, 100), "d": Fraction(1, 10), "da": Fraction(10)},
    **{"h": Fraction(100), "k": Fraction(1000), "M": Fraction(10**6), "G": Fraction(10**9), "T": Fraction(10**12)},
}
_PREFIX_WORDS = {
    **{"nano": Fraction(1, 10**9), "micro": Fraction(1, 10**6), "milli": Fraction(1, 1000)},
    **{
        "centi": Fraction(1, 100),
        "deca": Fraction(10),
        "kilo": Fraction(1000),
        "mega": Fraction(10**6),
        "giga": Fraction(10**9),
    },
}
_WITH_PREFIX = {
    "m": _unit(1, m=1),
    "g": _unit("0.001", kg=1),
    "s": _unit(1, s=1),
    "K": _unit(1, K=1),
    "A": _unit(1, A=1),
    "N": _unit(1, kg=1, m=1, s=-2),
    "Pa": _unit(1, kg=1, m=-1, s=-2),
    "J": _unit(1, kg=1, m=2, s=-2),
    "W": _unit(1, kg=1, m=2, s=-3),
    "V": _unit(1, kg=1, m=2, s=-3, A=-1),
    "Hz": _unit(1, s=-1),
    "bar": _unit(10**5, kg=1, m=-1, s=-2),
    "gf": _unit("0.00980665", kg=1, m=1, s=-2),
    "strain": _NO_DIMENSION,
    "ε": _NO_DIMENSION,
    "rad": _unit(1, angle=1),
}
_WORDS_WITH_PREFIX = {
    **dict.fromkeys(["metre", "meter"], _WITH_PREFIX["m"]),
    **{"gram": _WITH_PREFIX["g"], "second": _WITH_PREFIX["s"], "sec": _WITH_PREFIX["s"]},
    **{"newton": _WITH_PREFIX["N"], "pascal": _WITH_PREFIX["Pa"], "volt": _WITH_PREFIX["V"]},
    **{"strain": _NO_DIMENSION, "kelvin": _WITH_PREFIX["K"]},
}
_WITHOUT_PREFIX = {
    **dict.fromkeys(["%", "percent", "pct"], _unit(Fraction(1, 100))),
    **{"‰": _unit(Fraction(1, 1000)), "ppm": _unit(Fraction(1, 10**6)), "dimensionless": _NO_DIMENSION},
    **dict.fromkeys(["min", "mins", "minute"], _unit(60, s=1)),
    **dict.fromkeys(["h", "hr", "hour"], _unit(3600, s=1)),
    **dict.fromkeys(["d", "day"], _unit(86400, s=1)),
    **dict.fromkeys(["in", "inch", "inches", '"'], Unit(_INCH, {"m": 1})),
    **dict.fromkeys(["ft", "foot", "feet"], Unit(12 * _INCH, {"m": 1})),
    "mil": Unit(_INCH / 1000, {"m": 1}),
    **dict.fromkeys(["lbf"], Unit(_POUND_FORCE, {"kg": 1, "m": 1, "s": -2})),
    "kip": Unit(1000 * _POUND_FORCE, {"kg": 1, "m": 1, "s": -2}),
    "lb": _unit("0.45359237", kg=1),
    **dict.fromkeys(["t", "tonne"], _unit(1000, kg=1)),
    "kp": _unit("9.80665", kg=1, m=1, s=-2),
    "dyn": _unit("0.00001", kg=1, m=1, s=-2),
    **dict.fromkeys(["psi", "Psi", "PSI"], Unit(_PSI, {"kg": 1, "m": -1, "s": -2})),
    **dict.fromkeys(["ksi", "KSI"], Unit(1000 * _PSI, {"kg": 1, "m": -1, "s": -2})),
    "Msi": Unit(10**6 * _PSI, {"kg": 1, "m": -1, "s": -2}),
    "atm": _unit(101325, kg=1, m=-1, s=-2),
    "degC": Unit(Fraction(1), {"K": 1}, Fraction("273.15")),
    "degF": Unit(Fraction(5, 9), {"K": 1}, Fraction("459.67") * Fraction(5, 9)),
    **dict.fromkeys(["deg", "°"], Unit(Fraction(314159265358979, 180 * 10**14), {"angle": 1})),
    **dict.fromkeys(["cycle", "rev", "turn", "count", "pixel", "px"], _unit(1, count=1)),
}
# What laboratories write beyond the grammar. "C" is not the coulomb here, nor "S" the siemens.
_SPELLINGS = {
    **dict.fromkeys(["", "-", "–", "—", "1", "/", "none", "abs"], "dimensionless"),
    **dict.fromkeys(["S", "Sec", "SEC", "Seconds", "sec.", "secs", "Sek", "sek", "Sek.", "sek."], "s"),
    **dict.fromkeys(["C", "°C", "℃", "deg C", "deg. C", "Celsius", "celsius"], "degC"),
    **dict.fromkeys(["F", "°F", "℉", "deg F", "deg. F", "Fahrenheit", "fahrenheit"], "degF"),
    **dict.fromkeys(["Mpa", "mpa", "MPA"], "MPa"),
    **dict.fromkeys(["kpa", "Kpa", "KPa", "KPA"], "kPa"),
    **dict.fromkeys(["gpa", "Gpa", "GPA"], "GPa"),
    **dict.fromkeys(["pa", "PA"], "Pa"),
    **dict.fromkeys(["KN", "Kn", "kn"], "kN"),
    **dict.fromkeys(["MM", "Mm"], "mm"),
}
_SIGNS = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻⁺−·⋅∙×", "0123456789-+-****")
_FACTOR = re.compile(r"([^\W\d_]+|[%‰°\"])(?:(?:\^|\*\*)?([+-]?[1-9]))?(?![\d^])")
_OPERATOR = re.compile(r"\s*/\s*|\s*\*\s*|\s+per\s+|\s+")
_ONE_OVER = re.compile(r"1?\s*/\s*|per\s+")


def convert(values: FloatArray, unit: str, target: str) -> FloatArray:
    """Convert values from a unit as a laboratory spells it.

    Parameters
    ----------
    values : ndarray, shape (n,) [unit]
    unit : str
        For example ``"kPa"``, ``"N/mm²"``, ``"%"``, ``"1/min"``, ``"s^-1"``, ``"°C"``.
    target : str
        The unit wanted, in the same grammar.

    Returns
    -------
    ndarray, shape (n,) [target]

    Raises
    ------
    ValueError
        If the unit is unknown or measures something else; the caller adds the place in the file.

    Examples
    --------
    >>> convert(np.array([2.0, 5.0]), "N/mm2", "kPa")
    array([2000., 5000.])
    """
    if unit.strip() == "mPa":
        raise ValueError("unit 'mPa', millipascal")
    if unit.strip() == target:
        return values
    given, wanted = parse_unit(unit), parse_unit(target)
    if given is None or wanted is None:
        raise ValueError(f"unknown unit {quoted(unit)}")
    if given.powers != wanted.powers:
        raise ValueError(f"unit {quoted(unit)}")
    ratio = given.factor / wanted.factor
    shift = (given.offset - wanted.offset) / wanted.factor
    with np.errstate(
        over="ignore"
    ):  # what is beyond all numbers is refused with its place, as is all beyond the limits
        converted = values * float(ratio.numerator) / float(ratio.denominator)  # of 0.5 %, exactly 0.005
        return converted + float(shift) if shift else converted


def measures(text: str, target: str) -> bool:
    """Tell whether the text spells a unit of what `target` is a unit of.

    >>> measures("kN", "N"), measures("kN", "mm"), measures("Load", "N")
    (True, False, False)
    """
    try:
        convert(np.ones(1), text, target)
    except ValueError:
        return False
    return True


def is_percent(text: str) -> bool:
    """Tell whether the text spells hundredths.

    >>> [is_percent(text) for text in ("%", "pct", "mm", "-")]
    [True, True, False, False]
    """
    return parse_unit(text) == Unit(Fraction(1, 100))


def is_unit(text: str) -> bool:
    """Tell whether the text spells a unit.

    >>> [is_unit(text) for text in ("kN", "N/mm²", "%/min", "segments", "s**9**9**9")]
    [True, True, True, False, False]
    """
    return parse_unit(text) is not None


@lru_cache(maxsize=1024)
def parse_unit(text: str) -> Unit | None:
    """The unit that a text spells, or None.

    >>> parse_unit("N/mm2").factor
    Fraction(1000000, 1)
    """
    if len(text) > UNIT_CHARACTERS:
        return None
    text = text.strip()
    text = _SPELLINGS.get(text, text).translate(_SIGNS)
    if (alone := _symbol(text)) is not None:
        return alone
    factor, powers = Fraction(1), Counter[str]()
    over = _ONE_OVER.match(text)
    at, sign = (over.end(), -1) if over else (0, 1)
    while True:
        match = _FACTOR.match(text, at)
        symbol = _symbol(match[1]) if match else None
        if match is None or symbol is None:
            return None
        exponent = sign * int(match[2] or 1)
        factor *= symbol.factor**exponent
        for base, power in symbol.powers.items():
            powers[base] += exponent * power
        at = match.end()
        if at == len(text):
            return Unit(factor, {base: power for base, power in powers.items() if power})
        operator = _OPERATOR.match(text, at)
        if operator is None:
            return None
        sign = -1 if operator[0].strip() in ("/", "per") else 1
        at = operator.end()


def _symbol(text: str) -> Unit | None:
    """A known symbol or name, with its prefix."""
    for known, prefixes in (
        (_WITHOUT_PREFIX, {}),
        (_WITH_PREFIX, _PREFIXES),
        (_WORDS_WITH_PREFIX, _PREFIX_WORDS),
    ):
        plural = known is not _WITH_PREFIX and text.endswith("s") and len(text) > 2
        for name in (text, text[:-1]) if plural else (text,):
            if name in known:
                return known[name]
            for prefix, size in prefixes.items():
                if name.startswith(prefix) and name[len(prefix) :] in known:
                    unit = known[name[len(prefix) :]]
                    return Unit(size * unit.factor, unit.powers)
    return None
