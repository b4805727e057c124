"""``probation plan``: what planned tests would show, before any of them is done."""

from __future__ import annotations

import argparse
from itertools import count
from pathlib import Path
from typing import TYPE_CHECKING

from probation.commands.analysis_options import (
    add_effects,
    add_seed,
    add_threads,
    check_effects,
    effects_from_options,
)
from probation.commands.delivery import add_delivery, deliver, named_numbers, outputs_with_report
from probation.commands.law_options import add_law_options, law_from_options
from probation.commands.progress import in_parts, shown
from probation.commands.reading_options import add_reading, reading_from
from probation.commands.scheme_options import add_hold
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.histories import ImposedHistory

NAME = "plan"

_DESCRIPTION = """\
What would these tests tell, before any of them is done? The histories, the noise and a guess of the law say

  how well    the law's parameters would be known: expected standard errors, and correlations,
  which       effects of usual size could be detected (5 standard deviations above the noise),
  and which   of those could be discriminated, that is: not be taken for another.

  probation plan --history ramp:rate=0.001,strain=1.5 --history ramp:rate=0.02,strain=1.5 --noise 0.04 \\
      --set unrelaxed_modulus_MPa=3220 --set tau_max_s=5.2 --set hardening_modulus_MPa=2.5
  probation plan slow.csv dwell.csv --noise 0.04 --strain-noise 1e-4 --companion weissenberg:0.00464,0.0367 \\
      --set unrelaxed_modulus_MPa=3220 --set hardening_modulus_MPa=1.8 --report plan.html
  probation simulate --list-histories                   every history by name, with its parameters

A file has the columns time_s,true_strain; its instants are the samples that will be taken. All tests are judged
together, files first. Add a test to a plan and see what it is worth: half the noise does as much as four times the
samples, but a second rate or a dwell can discriminate what no number of samples does.

In a first reading: the first line, and the effects that "may be taken for" another.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="what planned tests would show", description=_DESCRIPTION)
    parser.add_argument("files", metavar="HISTORY.csv", nargs="*", help="time_s,true_strain of a planned test")
    parser.add_argument(
        "--history",
        metavar="NAME:PARAMETER=VALUE,…",
        action="append",
        default=[],
        help="a planned test by name; may be given several times",
    )
    add_law_options(parser)
    add_reading(parser)
    group = parser.add_argument_group("noise")
    group.add_argument(
        "--noise", metavar="MPA", type=float, required=True, help="standard deviation of the true stress in all tests"
    )
    group.add_argument(
        "--strain-noise",
        metavar="NUMBER",
        type=float,
        default=0.0,
        help="standard deviation of the measured true strain (0); it is propagated by smoothing and law to the stress",
    )
    add_hold(parser)
    add_effects(parser)
    add_seed(parser)
    add_threads(parser)
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    names = effects_from_options(options)
    check_effects(names)
    law, histories = law_from_options(options), _histories(options)
    from probation.design.plan import plan  # noqa: PLC0415 - see the package

    with shown("plan") as advance:
        answer = plan(
            law,
            histories,
            noise=options.noise,
            strain_noise=options.strain_noise,
            hold=named_numbers(options.hold, "--hold"),
            effects=names,
            seed=options.seed,
            threads=options.threads,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0


def _histories(options: argparse.Namespace) -> dict[str, ImposedHistory]:
    """The planned tests by the name of their file or history, numbered from the second of a name on."""
    from probation.histories import history_from  # noqa: PLC0415 - see the package
    from probation.histories.file import read_history  # noqa: PLC0415

    if not options.files and not options.history:
        raise InputError(
            "found no planned test, expected HISTORY.csv or --history; see probation simulate --list-histories"
        )
    tests = [(Path(file).stem, read_history(file, **reading_from(options)).history) for file in options.files]
    tests += [(text.partition(":")[0], history_from(text)) for text in options.history]
    found: dict[str, ImposedHistory] = {}
    for name, history in tests:
        numbers = (f"{name} {number}" for number in count(2))
        found[name if name not in found else next(numbered for numbered in numbers if numbered not in found)] = history
    return found
