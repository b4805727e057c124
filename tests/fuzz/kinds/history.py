"""History files of `simulate`."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.rows import HISTORIES, RECORDS
from fuzz.texts import hostile

if TYPE_CHECKING:
    from random import Random

NAME, SHARE = "history", 6

LAW = ("--set", "unrelaxed_modulus_MPa=3000", "--set", "hardening_modulus_MPa=2")
TIMES = (("--set", "tau_max_s=5"), ("--companion", "weissenberg:0.00464,0.0367"), ("--companion", "power:0.03,-1"))


def make(chance: Random) -> Case:
    """A history that went wrong, and a scheme to follow it."""
    data, _ = hostile((*HISTORIES, *HISTORIES, *HISTORIES, *RECORDS), chance)
    scheme = chance.choice(("be2", "sa2", "sa3", "exact"))
    output = chance.choice((("-o", "-"), ("--json", "-"), ()))
    command = ("simulate", "history-7.csv", "--scheme", scheme, *LAW, *chance.choice(TIMES), *output)
    return Case(NAME, command, {"history-7.csv": from_bytes(data)})
