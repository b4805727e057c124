"""``probation paper``: the paper's tables and figures, its numbers beside ours."""

from __future__ import annotations

import argparse

from probation.commands.analysis_options import whole_number
from probation.commands.delivery import Output, add_delivery, deliver, output_file, output_folder, outputs_with_report
from probation.commands.progress import shown
from probation.commands.streams import put

NAME = "paper"

PAGE = "probation-paper.html"

_DESCRIPTION = """\
Make the paper's tables and figures again from the embedded synthetic data of its experiments, its numbers beside ours:
each is reproduced, or differs for a stated reason. Needs no file; writes one self-contained page.

  probation paper                                   all of it, into ./probation-paper.html
  probation paper --only table-3 --only figure-5    these alone
  probation paper --out figures/                    every figure as PNG, too
  probation paper --draws 1000 --json paper.json    finer distributions, and the numbers as JSON
  probation paper --list                            the names for --only
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="the paper's tables and figures again", description=_DESCRIPTION)
    parser.add_argument("--list", action="store_true", help="list the tables and figures by name, and do nothing else")
    parser.add_argument("--only", metavar="NAME", action="append", default=[], help="this one; may be repeated")
    parser.add_argument("--seed", metavar="N", type=whole_number(0), default=0, help="of all draws and synthetic noise")
    parser.add_argument(
        "--draws", metavar="N", type=whole_number(1), default=100, help="how many draws of noise or bias (100)"
    )
    add_delivery(parser)
    parser.add_argument("--out", metavar="DIR", type=output_folder, help="save every figure into this folder, as PNG")
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation_studies.paper.exhibits import EXHIBITS  # noqa: PLC0415 - see the package
    from probation_studies.paper.reproduction import reproduce  # noqa: PLC0415

    if options.list:
        put("".join(f"{entry.name}\n" for entry in EXHIBITS))
        return 0
    options.report = options.report or output_file(PAGE)
    with shown("the paper") as advance:
        answer = reproduce(options.only, seed=options.seed, draws=options.draws, progress=advance)

    def save_figures(folder: str) -> str:
        return f"{len(answer.save_figures(folder))} files into {folder}"

    deliver(answer.summary(), [*outputs_with_report(answer, options), Output("figures", options.out, save_figures)])
    return 0
