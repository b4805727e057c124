"""Records in CSV, of every profile."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz import odd
from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.rows import RECORDS
from fuzz.texts import hostile

if TYPE_CHECKING:
    from random import Random

NAME, SHARE = "csv", 20

_PROFILES = ("csv", "excel", "etfe", "etfe_relaxation", "etfe_temperature", "vhb", "silicone", "no")
_ODD_OPTIONS = (
    *(("--unit", f"{role}={unit}") for role in ("time", "true_strain", "force") for unit in odd.UNITS if unit),
    *(("--column", f"true_stress={label}") for label in ("1", "2", "99", "0", "nan", "Load", "x" * 300, "\x1b[31m")),
    *(("--specimen", f"area_mm2={value}") for value in ("0", "1e-320", "1e308", "nan", "-1")),
    *(("--specimen", f"gauge_length_mm={value}") for value in ("0", "1e-320", "1e308", "nan", "-1")),
    *(("--profile", name) for name in _PROFILES),
    *(("--specimen-index", value) for value in ("1", "2", "0", "-1", "99999999999999999999")), ("--sheet", "Sheet1"),
)  # fmt: skip


def make(chance: Random) -> Case:
    """A record that went wrong, and a command that reads it."""
    data, seed = hostile(RECORDS, chance)
    return record_case(NAME, "tension-7.csv", data, seed.options, chance)


def record_case(kind: str, name: str, data: bytes, options: tuple[str, ...], chance: Random) -> Case:
    """A record in a file, and a command that reads it."""
    extra = chance.choice(_ODD_OPTIONS) if chance.random() < 0.1 else ()
    asked = chance.choice(("preview",) * 3 if options else ("preview", "preview", "fit", "fit", "excitation"))
    command = (asked, name, *options, *extra) if asked == "preview" else (asked, name)
    return Case(kind, command, {name: from_bytes(data)})
