"""``probation coverage``: whether the 95 % intervals of a fit hold."""

from __future__ import annotations

import argparse

from probation.commands.delivery import add_delivery, deliver, output_file, usual_outputs
from probation.commands.progress import shown

NAME = "coverage"

_DESCRIPTION = """\
Make records whose truth is known, fit them, and count how often the 95 % intervals contain it: where strain noise
dominates, where stress noise does, and where that is autocorrelated; by plain least squares, by a frozen weighting
and by the recommended one.

  probation coverage --draws 60
  probation coverage --draws 1000 --processes 2 --state coverage.jsonl --plot coverage.png

The second takes about half an hour on two cores; started again it goes on where it was stopped.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="whether the intervals of a fit hold", description=_DESCRIPTION)
    parser.add_argument("--draws", metavar="N", type=int, default=200, help="records of each kind of noise (200)")
    parser.add_argument("--seed", metavar="N", type=int, default=0, help="of the noise (0)")
    parser.add_argument("--processes", metavar="N", type=int, default=1, help="how many run at a time (1)")
    parser.add_argument(
        "--state", metavar="FILE", type=output_file, help="keep every draw in this file, and do none again that it has"
    )
    add_delivery(parser, report=False)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation_studies.coverage.study import study  # noqa: PLC0415 - see the package

    with shown("counting") as advance:
        answer = study(
            options.draws, seed=options.seed, processes=options.processes, state=options.state, progress=advance
        )
    deliver(answer.summary(), usual_outputs(answer, options))
    return 0
