"""``probation preview``: how a file would be read."""

from __future__ import annotations

import argparse

from probation.commands.delivery import add_delivery, deliver, usual_outputs
from probation.commands.progress import shown
from probation.commands.reading_options import add_reading, reading_from

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
    add_reading(parser)
    add_delivery(parser, report=False)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.records.preview import preview  # noqa: PLC0415 - see the package

    with shown(f"reading {options.file}"):
        found = preview(options.file, **reading_from(options))
    deliver(found.summary(), usual_outputs(found, options))
    return 0
