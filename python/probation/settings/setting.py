"""One constant of the statistics, with what a reader wants to know of it.

A field of a frozen dataclass of settings is made by the word that says where its value comes from: `derived` by an
argument, `chosen` by judgement, `calibrated` on data. The arguments are the value; its unit, "-" for a pure number; its
meaning in one sentence; and the source, which is the argument, the standard or the data.
"""

from __future__ import annotations

from dataclasses import field
from functools import partial
from typing import Any, Literal

Origin = Literal["derived", "chosen", "calibrated"]


def _setting(origin: Origin, value: object, unit: str, meaning: str, source: str = "") -> Any:
    return field(default=value, metadata={"meaning": meaning, "unit": unit, "origin": origin, "source": source})


derived = partial(_setting, "derived")
chosen = partial(_setting, "chosen")
calibrated = partial(_setting, "calibrated")
