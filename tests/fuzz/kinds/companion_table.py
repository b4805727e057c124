"""Tables of relaxation times by strain rate."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.rows import rate_table
from fuzz.texts import hostile

if TYPE_CHECKING:
    from random import Random

NAME, SHARE = "companion table", 6

_FORMS = ("auto", "weissenberg", "exponential", "power", "table")
_LAW = ("--set", "unrelaxed_modulus_MPa=3000", "--set", "hardening_modulus_MPa=2")


def make(chance: Random) -> Case:
    """A table that went wrong, regressed or used as it is."""
    data, _ = hostile((rate_table,), chance)
    commands = (
        *(("companion", "times-7.csv", "--form", form) for form in _FORMS),
        ("companion", "times-7.csv", "--json", "-"),
        ("simulate", "--history", "ramp:rate=0.001,strain=1", *_LAW, "--companion", "table:times-7.csv"),
        ("simulate", "--history", "ramp:rate=0.001,strain=1", *_LAW, "--companion", "table:times-7.csv", "-o", "-"),
    )  # fmt: skip
    return Case(NAME, chance.choice(commands), {"times-7.csv": from_bytes(data)})
