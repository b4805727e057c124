"""Records in gzip: a checksum stands at the end, so that damage is refused or did not touch the numbers."""

from __future__ import annotations

import gzip
from typing import TYPE_CHECKING

from fuzz.bytes_damage import damaged
from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.kinds.comma_separated import record_case
from fuzz.rows import RECORDS, plain, plain_truth
from fuzz.texts import hostile, render

if TYPE_CHECKING:
    from random import Random

NAME, SHARE = "gz", 6


def make(chance: Random) -> Case:
    """A damaged gzip of a good record, or a good gzip of a record that went wrong."""
    if chance.random() < 0.4:
        data, seed = hostile(RECORDS, chance)
        return record_case(NAME, "tension-7.csv.gz", gzip.compress(data, mtime=0), seed.options, chance)
    data = _compressed(render(plain()).encode("ascii"), chance)
    for _ in range(chance.choice((1, 1, 2))):
        data = damaged(data, chance)
    return Case(NAME, ("read", "tension-7.csv.gz"), {"tension-7.csv.gz": from_bytes(data)}, truth=plain_truth())


def _compressed(text: bytes, chance: Random) -> bytes:
    """In one member, in two, or compressed twice."""
    match chance.choice(("once", "once", "members", "twice")):
        case "members":
            half = len(text) // 2
            return gzip.compress(text[:half], mtime=0) + gzip.compress(text[half:], mtime=0)
        case "twice":
            return gzip.compress(gzip.compress(text, mtime=0), mtime=0)
    return gzip.compress(text, mtime=0)
