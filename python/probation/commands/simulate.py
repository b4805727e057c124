"""``probation simulate``: what the law answers to a history."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from probation.commands.delivery import (
    add_delivery,
    deliver,
    output_file_or_stream,
    text_output,
    usual_outputs,
    warn,
)
from probation.commands.law_options import add_law_options, law_from_options
from probation.commands.progress import shown
from probation.commands.reading_options import add_reading, reading_from
from probation.commands.scheme_options import add_scheme, add_start
from probation.commands.streams import put
from probation.errors import InputError
from probation.law.schemes import CVODE, SCHEMES, Scheme, scheme_of

if TYPE_CHECKING:
    from probation.histories import ImposedHistory

NAME = "simulate"

_DESCRIPTION = """\
True stress along a strain history, from a file or by name.

  probation simulate history.csv --scheme sa3 --set unrelaxed_modulus_MPa=3220 --set tau_max_s=5.2 \\
      --set hardening_modulus_MPa=2.5 -o stress.csv
  probation simulate --history necking:grip_speed=0.02 --companion weissenberg:0.00464,0.0367 \\
      --set unrelaxed_modulus_MPa=3220 --set hardening_modulus_MPa=1.8 --plot necking.png
  probation simulate --list-histories

A file has the columns time_s,true_strain and perhaps strain_rate_per_s; without rates its samples mean the
piecewise-linear history between them. The answer has time_s,true_strain,true_stress_MPa at the same instants,
every digit kept. Without -o, a picture of it goes to the terminal.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="true stress along a strain history", description=_DESCRIPTION)
    parser.add_argument(
        "file", metavar="HISTORY.csv", nargs="?", help="time_s,true_strain and perhaps strain_rate_per_s"
    )
    parser.add_argument("--history", metavar="NAME:PARAMETER=VALUE,…", help="a history by name instead of a file")
    parser.add_argument("--list-histories", action="store_true", help="list their names, parameters, units, defaults")
    add_law_options(parser)
    add_reading(parser)
    group = parser.add_argument_group("scheme")
    add_scheme(group, choices=SCHEMES)
    add_start(group)
    group.add_argument(
        "--tolerance",
        metavar="NUMBER",
        type=float,
        default=1e-10,
        help="of cvode, relative, and absolute in MPa (1e-10)",
    )
    add_delivery(parser, report=False)
    parser.add_argument(
        "-o",
        "--output",
        metavar="OUT.csv",
        type=output_file_or_stream,
        help="write the answer; - is standard output",
    )
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.histories import list_histories  # noqa: PLC0415 - see the package
    from probation.simulation import simulate  # noqa: PLC0415

    if options.list_histories:
        put(list_histories() + "\n")
        return 0
    if options.output == "-" and options.json == "-":
        raise InputError("found both -o - and --json -, expected one of them on standard output")
    history = _history(options)
    law, scheme = law_from_options(options), _scheme(options)
    with shown(f"simulating {history.name} by {options.scheme}"):
        simulation = simulate(law, history, scheme)
    for warning in simulation.warnings:
        warn(warning)
    summary = "" if options.output == "-" else simulation.summary(picture=options.output is None)
    deliver(
        summary,
        [text_output("CSV", options.output, simulation.to_csv), *usual_outputs(simulation, options)],
    )
    return 0


def _scheme(options: argparse.Namespace) -> Scheme:
    if options.scheme == "cvode":
        return CVODE(relative_tolerance=options.tolerance, absolute_tolerance=options.tolerance)
    return scheme_of(options.scheme, options.start)


def _history(options: argparse.Namespace) -> ImposedHistory:
    from probation.histories import history_from  # noqa: PLC0415
    from probation.histories.file import read_history  # noqa: PLC0415

    if (options.file is None) == (options.history is None):
        both = "both a file and --history" if options.file else "neither a file nor --history"
        raise InputError(f"found {both}, expected one of them; --list-histories lists the names")
    return (
        history_from(options.history)
        if options.history
        else read_history(options.file, **reading_from(options)).history
    )
