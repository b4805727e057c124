"""One constant of the statistics, with what a reader wants to know of it."""

from __future__ import annotations

from dataclasses import field
from typing import Any, Literal

Origin = Literal["derived", "chosen", "calibrated"]


def setting(value: object, meaning: str, *, unit: str, origin: Origin, source: str = "", used_in: str) -> Any:
    """A field of a frozen dataclass of settings.

    Parameters
    ----------
    value : object
    meaning : str
        One sentence.
    unit : str
        "-" for a pure number.
    origin : {"derived", "chosen", "calibrated"}
        By an argument, by judgement, or on data.
    source : str
        Which argument, or which data.
    used_in : str
        The module, below ``python/probation``.
    """
    known = {"meaning": meaning, "unit": unit, "origin": origin, "source": source, "used_in": used_in}
    return field(default=value, metadata=known)
