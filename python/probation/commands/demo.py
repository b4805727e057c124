"""``probation demo``: see it work, without any file."""

from __future__ import annotations

import argparse
from pathlib import Path

from probation.commands.delivery import Output, add_json, deliver, output_folder, text_output
from probation.commands.progress import shown

NAME = "demo"

FOLDER = "probation-demo"

_DESCRIPTION = """\
See it work, without any file: the embedded synthetic data of the paper's three experiments through every step.

  probation demo                  writes a page, plots and the synthetic data into ./probation-demo
  probation demo --no-files       prints only
  probation fit probation-demo/experiment-1
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="see it work, without any file", description=_DESCRIPTION)
    where = parser.add_mutually_exclusive_group()
    where.add_argument("--out", metavar="DIR", type=output_folder, help="where to write (./probation-demo)")
    where.add_argument("--no-files", action="store_true", help="write nothing")
    add_json(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.demo import demonstrate  # noqa: PLC0415 - see the package

    folder = None if options.no_files else options.out or output_folder(FOLDER)
    with shown("demonstration") as advance:
        demo = demonstrate(advance)

    def write(place: str) -> str:
        written = ", ".join(demo.write(place))
        return f"{written} into {place}; next: probation fit {Path(place) / 'experiment-1'}"

    deliver(demo.summary(), [text_output("JSON", options.json, demo.to_json), Output("files", folder, write)])
    return 0
