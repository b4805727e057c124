"""``probation companion`` with the paper's own table."""

from __future__ import annotations

import argparse

from probation.commands import companion
from probation.errors import InputError

NAME = companion.NAME


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = companion.add_parser(subparsers)
    parser.add_argument(
        "--table-2",
        action="store_true",
        help="the paper's own Table 2 instead of a source: Figure S2, with (11) and (12)",
    )
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    if not options.table_2:
        return companion.run(options)
    from probation_studies.paper.calibration_on_table_2 import CalibrationOnTable2  # noqa: PLC0415 - see the package
    from probation_studies.paper.relations import RATE_TABLE  # noqa: PLC0415

    if options.source:
        raise InputError(f"found {options.source[0]!r} together with --table-2, expected one of them")
    return companion.run(options, RATE_TABLE, CalibrationOnTable2)
