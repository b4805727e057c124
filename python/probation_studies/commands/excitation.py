"""``probation excitation`` with a comparison of its methods."""

from __future__ import annotations

import argparse

from probation.commands import excitation
from probation.commands.analysis_options import whole_number
from probation.commands.delivery import deliver, usual_outputs
from probation.commands.progress import shown
from probation.errors import InputError

NAME = excitation.NAME


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = excitation.add_parser(subparsers)
    group = parser.add_argument_group("comparison")
    group.add_argument(
        "--compare",
        action="store_true",
        help="compare the methods on histories whose rate is known; takes minutes, --draws 1 a fifth of them",
    )
    group.add_argument("--draws", metavar="N", type=whole_number(1), help="draws of the noise that are compared (5)")
    group.add_argument("--seed", metavar="N", type=int, help="of the noise that is compared (0)")
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    if options.compare:
        return _compare(options)
    if options.draws is not None or options.seed is not None:
        raise InputError("found --draws or --seed without --compare")
    return excitation.run(options)


def _compare(options: argparse.Namespace) -> int:
    from probation_studies.smoothing.comparison import DRAWS, compare  # noqa: PLC0415 - see the package

    given = [name for name in ("file", "record", "csv", "report") if getattr(options, name)]
    if given or options.method != "auto":
        found = {"file": "FILE"}.get(given[0], f"--{given[0]}") if given else "--method"
        raise InputError(f"found {found} together with --compare, expected only --draws, --seed, --json and --plot")
    with shown("comparing") as advance:
        answer = compare(draws=options.draws or DRAWS, seed=options.seed or 0, progress=advance)
    deliver(answer.summary(), usual_outputs(answer, options))
    return 0
