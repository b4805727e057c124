"""``probation demo``: see it work, without any file."""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from probation._files import kind_of, write_whole
from probation.commands.delivery import said, tell
from probation.commands.progress import shown
from probation.errors import InputError

NAME = "demo"

_DESCRIPTION = """\
See it work, without any file: the embedded twins of the paper's three experiments through every step.

  probation demo                  writes a page, plots and the twins into ./probation-demo
  probation demo --no-files       only tells
  probation fit probation-demo/experiment-1
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="see it work, without any file", description=_DESCRIPTION)
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--out", metavar="DIR", default="probation-demo", help="where to write (./probation-demo)")
    where.add_argument("--no-files", action="store_true", help="write nothing")
    parser.add_argument(
        "--json", metavar="FILE", help="write the answer as JSON; - is standard output, and alone there"
    )
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.demo import demonstrate  # noqa: PLC0415 - see the package

    if not options.no_files:
        _check_folder(Path(options.out))
    with shown("demonstration") as advance:
        demo = demonstrate(advance)
    tell(demo.summary(), sys.stderr if options.json == "-" else sys.stdout)
    if options.json == "-":
        sys.stdout.write(demo.to_json())
    elif options.json:
        write_whole(options.json, demo.to_json())
        said("JSON", options.json)
    if not options.no_files:
        written = demo.write(options.out)
        said(", ".join(written), f"into {options.out}; next: probation fit {Path(options.out) / 'experiment-1'}")
    return 0


def _check_folder(folder: Path) -> None:
    if kind_of(folder) not in (None, "a folder"):
        raise InputError(f"--out {folder}: found a file, expected a folder or a new name")
