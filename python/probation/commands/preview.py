"""``probation preview``: how a file would be read."""

from __future__ import annotations

import argparse

from probation.commands.delivery import deliver, named_numbers, plot_file, plot_output
from probation.errors import InputError

NAME = "preview"

_DESCRIPTION = """\
Show how a file would be read, before anything depends on it: its layout, which column plays which role, units,
ranges, noise, warnings, and a small plot.

  probation preview tension.csv
  probation preview export.xlsx --column force="Load (kN)" --column displacement=3 \\
      --specimen area_mm2=22 --specimen gauge_length_mm=80
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="how a file would be read", description=_DESCRIPTION)
    parser.add_argument("file", metavar="FILE", help="CSV, TSV, .xlsx, or what an import profile reads")
    parser.add_argument("--profile", metavar="NAME", help="import profile; by default recognised from the content")
    parser.add_argument(
        "--column",
        metavar="ROLE=HEADING",
        action="append",
        default=[],
        help="which column is which, by heading or by position counted from 1",
    )
    parser.add_argument("--unit", metavar="ROLE=UNIT", action="append", default=[], help="unit of a column")
    parser.add_argument(
        "--specimen", metavar="NAME=VALUE", action="append", default=[], help="area_mm2, gauge_length_mm"
    )
    parser.add_argument("--specimen-index", metavar="N", type=int, help="of specimens side by side, only this one")
    parser.add_argument("--sheet", metavar="NAME", help="of an Excel workbook")
    parser.add_argument("--plot", metavar="FILE", type=plot_file, help="save a plot, as .png, .svg or .pdf")
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.records.preview import preview  # noqa: PLC0415 - see the package

    shown = preview(
        options.file,
        profile=options.profile,
        columns={role: _heading(text) for role, text in _pairs(options.column, "--column").items()},
        units=_pairs(options.unit, "--unit"),
        specimen=named_numbers(options.specimen, "--specimen"),
        specimen_index=options.specimen_index,
        sheet=options.sheet,
    )
    deliver(shown.summary(), [plot_output(shown, options.plot)])
    return 0


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
