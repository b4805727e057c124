"""Campaigns: what stands in campaign.toml, line by line, and the files that it names."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz import odd
from fuzz.bytes_damage import damaged
from fuzz.case import Case
from fuzz.content import from_bytes, to_bytes
from fuzz.kinds.workbook import members
from fuzz.row_mutations import mutated
from fuzz.rows import HISTORIES, machine, plain, with_rate_and_temperature
from fuzz.texts import render

if TYPE_CHECKING:
    from collections.abc import Callable
    from random import Random

    from fuzz.content import Content

NAME, SHARE = "campaign", 14

_PLAIN = """\
name = "hdpe-7"

[law]
modes = 12
decades = 4.0

[law.fixed]
hardening_modulus_MPa = 2.0

[[record]]
id = "ramp-1"
file = "ramp-1.csv"
control = "strain-rate"
role = "identify"

[[record]]
id = "ramp-2"
file = "ramp-2.csv"
control = "strain-rate"
role = "held-out"
"""
_FULL = """\
name = "hdpe-7"

[law]
modes = 50
decades = 6.0
accuracy = 1e-3

[law.companion]
form = "weissenberg"
slope = 0.00464
intercept = 0.0367
calibrated_rates_per_s = [5e-5, 1e-2]
log_scatter = 0.05
covariance = [[1e-8, 0.0, 0.0], [0.0, 1e-6, 0.0], [0.0, 0.0, 100.0]]
unrelaxed_modulus_MPa = 3000.0

[law.fixed]
alpha = 1.0

[[record]]
id = "tension-7"
file = "machine.csv"
control = "displacement-rate"
columns = { time = "Time", displacement = "Extension", force = 3 }
units = { force = "kN" }
specimen = { area_mm2 = 40.0, gauge_length_mm = 25.0 }
profile = "csv"
specimen_index = 1
noise = { stress_MPa = 0.04, strain = 1e-4 }
temperature_C = 23.0

[[record]]
id = "book"
file = "book.xlsx"
sheet = "Data"
temperature_file = "chamber.csv"
"""
_TABLE = """\
[law.companion]
form = "table"
rates = [1e-4, 1e-3, 1e-2]
tau_max_s = [200.0, 30.0, 4.0]

[[record]]
id = "warm-1"
file = "warm.csv"
"""
SEEDS = (_PLAIN, _FULL, _TABLE)
_NUMBERS = (
    "0", "1", "2", "3", "12", "1e-320", "1e-30", "1e-9", "1e-3", "0.5", "1e3", "1e6", "1e15", "1e30", "1e308", "-1",
)  # fmt: skip
_WORDS = (
    '"x"', '"ramp-1"', '"ramp-1.csv"', '"warm.csv"', '"machine.csv"', '"book.xlsx"', '"chamber.csv"', '"strain-rate"',
    '"hold"', '"other"', '"held-out"', '"identify"', '"csv"', '"excel"', '"vhb"', '"Data"', '"kN"', '"table"',
    '"power"',
)  # fmt: skip
_LINES = (
    "[law]", "[[law]]", "[record]", "[[record]]", "[law.companion]", "[law.fixed]", "[[record.columns]]",
    "[record.noise]", "[a.b.c]", "[[a]]", "[]", "x = 1", "law.modes = 3", "law = 1", "record = []", "record = 1",
    '"" = 1', '"a\\u0000b" = 1', "'\x1b[31m' = 1", 'name = "again"', "[" * 2000, "x = " + "[" * 2000 + "]" * 2000,
    "x = {" * 500, "a" + ".a" * 2000 + " = 1", "# \x1b[31m", "\x00", "\t\t", "[law.fixed.x]", "companion = {}",
    "fixed = 3", "modes = 1", 'id = "ramp-1"', "x" * 30_000 + " = 1",
)  # fmt: skip


def make(chance: Random) -> Case:
    """A campaign.toml with one to three lines that went wrong, perhaps a record too."""
    lines = chance.choice(SEEDS).splitlines()
    for _ in range(chance.choice((1, 1, 1, 1, 2, 3))):
        lines = _changed(lines, chance)
    data = "\n".join(lines).encode("utf-8", "surrogatepass")
    if chance.random() < 0.04:
        data = damaged(data, chance)
    files = records(chance)
    if chance.random() < 0.03:
        del files[chance.choice(list(files))]
    files["campaign.toml"] = from_bytes(data)
    asked = chance.choice(("load",) * 7 + ("fit", "crosscheck", "certify", "companion"))
    return Case(NAME, (asked, chance.choice((".", "campaign.toml"))), files)


def records(chance: Random, wrong: float = 0.1) -> dict[str, Content]:
    """The files that the seeds name, one of them gone wrong with this probability."""
    chamber = "t,TMean01\n" + "".join(f"{0.5 * at},{23 + 0.01 * at}\n" for at in range(14))
    files: dict[str, Content] = {
        "ramp-1.csv": render(plain()),
        "ramp-2.csv": render(plain()),
        "machine.csv": render(machine()),
        "warm.csv": render(with_rate_and_temperature()),
        "chamber.csv": chamber,
        "book.xlsx": {"zip": members(plain().cells)},
    }
    if chance.random() < wrong:
        name = chance.choice(list(files))
        files[name] = chance.choice(_WRONG)(to_bytes(files[name]), chance)
    return files


def _wrong_table(_: bytes, chance: Random) -> Content:
    return render(mutated(chance.choice((plain, machine, *HISTORIES))(), chance))


def _wrong_bytes(data: bytes, chance: Random) -> Content:
    return from_bytes(damaged(data, chance))


_WRONG: tuple[Callable[[bytes, Random], Content], ...] = (_wrong_table, _wrong_bytes)


def _changed(lines: list[str], chance: Random) -> list[str]:
    """One line that went wrong."""
    lines = list(lines)
    at = chance.randrange(len(lines))
    match chance.choice(
        ("value",) * 5 + ("entry", "key", "key", "lost", "again", "insert", "insert", "cut", "indent", "moved")
    ):
        case "value":
            at = chance.choice([at for at, line in enumerate(lines) if " = " in line] or [0])
            key = lines[at].partition(" = ")[0]
            lines[at] = f"{key} = {_other_value(lines[at], chance)}"
        case "entry":
            tables = [at for at, line in enumerate(lines) if "{" in line or "[" in line.partition("=")[2]]
            if tables:
                at = chance.choice(tables)
                lines[at] = _entry_changed(lines[at], chance)
        case "key":
            key, equals, value = lines[at].partition(" = ")
            other = (key.upper(), f"{key}x", key[:-1], "modes", "file", "1", "a.b", f"{key}.x", f"“{key}")
            lines[at] = f"{chance.choice(other)}{equals}{value}"
        case "lost":
            del lines[at]
        case "again":
            lines.insert(at, lines[at])
        case "insert":
            lines.insert(at, chance.choice(_LINES))
        case "cut":
            lines[at] = lines[at][: chance.randrange(len(lines[at]) + 1)]
        case "indent":
            lines[at] = chance.choice(("  ", "\t", "\u00a0", "\ufeff", "﻿#")) + lines[at]
        case "moved":
            lines.insert(chance.randrange(len(lines)), lines.pop(at))
    return lines or [""]


def _other_value(line: str, chance: Random) -> str:
    """A value of the same type as often as any other."""
    old = line.partition(" = ")[2]
    if chance.random() < 0.5 or old.startswith(("[", "{")):
        return chance.choice(odd.TOML_VALUES)
    return chance.choice(_WORDS if old.startswith('"') else _NUMBERS)


def _entry_changed(line: str, chance: Random) -> str:
    """Another value in a table or list on one line."""
    head, separator, rest = line.partition(" = ")
    pieces = rest.split(", ")
    at = chance.randrange(len(pieces))
    before, equals, _ = pieces[at].rpartition("= ")
    closing = pieces[at][len(pieces[at].rstrip(" ]}")) :]
    pieces[at] = f"{before}{equals}{chance.choice(odd.TOML_VALUES)}{closing}"
    return f"{head}{separator}{', '.join(pieces)}"
