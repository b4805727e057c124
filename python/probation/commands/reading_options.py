"""How files are read, from the command line: the same options wherever a file is read."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from probation.commands.delivery import named_numbers
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.records.options import ReadingKeys

_OPTIONS = ("profile", "column", "unit", "specimen", "specimen_index", "sheet", "test_rate", "strain_file")


def add_reading(parser: argparse.ArgumentParser) -> argparse._ArgumentGroup:
    """Add the options that say how a data file is read."""
    group = parser.add_argument_group("how data files are read", "probation preview FILE shows what they do.")
    group.add_argument("--profile", metavar="NAME", help="import profile; by default recognised from the content")
    group.add_argument(
        "--column",
        metavar="ROLE=HEADING",
        action="append",
        default=[],
        help="which column is which, by heading or by position counted from 1: time=…, engineering_strain=…, force=…",
    )
    group.add_argument(
        "--unit", metavar="ROLE=UNIT", action="append", default=[], help="unit of a column, such as force=kN"
    )
    group.add_argument(
        "--specimen",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="area_mm2, or width_mm and thickness_mm, or diameter_mm; gauge_length_mm",
    )
    group.add_argument("--specimen-index", metavar="N", type=int, help="of several specimens in a file, only this one")
    group.add_argument("--sheet", metavar="NAME", help="of an Excel workbook")
    group.add_argument(
        "--test-rate", metavar="RATE", help='of a file without time: "0.001 1/s", or "2 mm/min" by gauge_length_mm'
    )
    film = parser.add_argument_group(
        "strain from another file, on a clock of its own", "A video extensometer, image correlation."
    )
    film.add_argument("--strain-file", metavar="FILE", help="where the strain is; the shift is estimated and shown")
    film.add_argument(
        "--strain-column", metavar="ROLE=HEADING", action="append", default=[], help="of that file, as --column"
    )
    film.add_argument("--strain-unit", metavar="ROLE=UNIT", action="append", default=[], help="of that file, as --unit")
    film.add_argument(
        "--strain-gauge-length", metavar="MM", type=float, help="of that file, where it holds a displacement"
    )
    film.add_argument("--strain-shift", metavar="S", type=float, help="what is added to its time, where it is known")
    return group


def reading_from(options: argparse.Namespace) -> ReadingKeys:
    """The keywords of `read_records` that the options say.

    Raises
    ------
    InputError
        If an option has not the form that its help says.
    """
    return {
        "profile": options.profile,
        "columns": {role: _heading(text) for role, text in _pairs(options.column, "--column").items()},
        "units": _pairs(options.unit, "--unit"),
        "specimen": named_numbers(options.specimen, "--specimen"),
        "specimen_index": options.specimen_index,
        "sheet": options.sheet,
        "test_rate": options.test_rate,
        "strain_from": _strain_from(options),
    }


def _strain_from(options: argparse.Namespace) -> dict[str, object] | None:
    if options.strain_file is None:
        for name in ("strain_column", "strain_unit", "strain_gauge_length", "strain_shift"):
            if getattr(options, name) not in (None, []):
                raise InputError(f"found --{name.replace('_', '-')} without --strain-file, expected both or neither")
        return None
    length = options.strain_gauge_length
    return {
        "file": str(Path(options.strain_file).absolute()),
        "columns": {role: _heading(text) for role, text in _pairs(options.strain_column, "--strain-column").items()},
        "units": _pairs(options.strain_unit, "--strain-unit"),
        "specimen": {} if length is None else {"gauge_length_mm": length},
        "shift_s": options.strain_shift,
    }


def refuse_reading(options: argparse.Namespace, what: str, remedy: str) -> None:
    """Refuse the options where no data file is read.

    Raises
    ------
    InputError
        Naming the first that was given.
    """
    for name in _OPTIONS:
        if getattr(options, name) not in (None, []):
            raise InputError(f"found --{name.replace('_', '-')} with {what}, expected it with data files; {remedy}")


def _pairs(entries: list[str], option: str) -> dict[str, str]:
    pairs: dict[str, str] = {}
    for entry in entries:
        role, equals, text = (part.strip() for part in entry.partition("="))
        if not (equals and role and text):
            raise InputError(f"{option}: found {entry!r}, expected ROLE=…")
        if role in pairs:
            raise InputError(f"{option}: found {role} twice, expected it once")
        pairs[role] = text
    return pairs


def _heading(text: str) -> str | int:
    return int(text) if text.isdecimal() else text
