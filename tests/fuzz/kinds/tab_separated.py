"""Records in TSV."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz.kinds.comma_separated import record_case
from fuzz.rows import WITH_HEADINGS
from fuzz.texts import hostile

if TYPE_CHECKING:
    from random import Random

    from fuzz.case import Case

NAME, SHARE = "tsv", 6


def make(chance: Random) -> Case:
    """A record that went wrong, with tabs between the cells."""
    data, seed = hostile(WITH_HEADINGS, chance, "\t")
    return record_case(NAME, "tension-7.tsv", data, seed.options, chance)
