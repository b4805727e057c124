"""What `init` makes a campaign of: one to three records under odd names, some with their strain in a second file."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.rows import HISTORIES, RECORDS, history, machine
from fuzz.texts import encoded, hostile, render

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from fuzz.rows import Rows

NAME, SHARE = "laboratory", 8

_NAMES = (
    "tension 7", "Prüfung-7", "試験7", "tension\u202e7", "tension\u200b7", "tension'7", 'tension"7', "tension=7",
    "tension:7", "-tension7", "tension#7", "tension\\7", "tension\n7", "tension\x1b[31m7", "campaign", "records",
    "tension7" * 20,
)  # fmt: skip
_SHIFTS = ("0", "-2.5", "1e9", "1e-320", "nan", "x")


def make(chance: Random) -> Case:
    """Files that went wrong, or only their names, and the command that makes a campaign of them."""
    if chance.random() < 0.4:
        return _filmed(chance)
    chosen = chance.sample(_NAMES, chance.choice((1, 1, 2, 3)))
    names = [f"{name}.{chance.choice(('csv', 'CSV', 'txt', 'toml', 'tar.csv'))}" for name in chosen]
    files = {name: hostile(RECORDS, chance)[0] if chance.random() < 0.5 else _sound(machine) for name in names}
    options = ("--specimen", "area_mm2=40", "--specimen", "gauge_length_mm=25")
    command = ("init", *(f"./{name}" for name in names), "-o", "made", "--yes", *options)
    return Case(NAME, command, {name: from_bytes(data) for name, data in files.items()})


def _filmed(chance: Random) -> Case:
    """A force file, and a strain file on another clock."""
    wrong = chance.choice(("force", "film", "film", "neither"))
    force = hostile((machine,), chance)[0] if wrong == "force" else _sound(machine)
    film = hostile(HISTORIES, chance)[0] if wrong == "film" else _sound(history)
    shift = ("--strain-shift", chance.choice(_SHIFTS)) if chance.random() < 0.6 else ()
    asked = ("init", "force-7.csv", "-o", "made", "--yes") if chance.random() < 0.7 else ("preview", "force-7.csv")
    command = (*asked, "--strain-file", "film-7.csv", "--specimen", "area_mm2=40", *shift)
    return Case(NAME, command, {"force-7.csv": from_bytes(force), "film-7.csv": from_bytes(film)})


def _sound(make: Callable[[], Rows]) -> bytes:
    rows = make()
    return encoded(render(rows), rows.encoding)
