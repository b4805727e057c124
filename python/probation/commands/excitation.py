"""``probation excitation``: strain, rate, and how well they are known."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from probation.commands.analysis_options import whole_number
from probation.commands.campaign_options import add_data_files, campaign_at, is_data_file
from probation.commands.delivery import (
    add_delivery,
    deliver,
    output_file_or_stream,
    outputs_with_report,
    text_output,
    usual_outputs,
)
from probation.commands.progress import shown
from probation.commands.reading_options import reading_from
from probation.errors import InputError
from probation.smoothing.methods import DEFAULT, METHODS

if TYPE_CHECKING:
    from probation.records.record import Record

NAME = "excitation"

_DESCRIPTION = f"""\
The strain and strain rate that drive the law, made of measured, noisy strain: how large, how well known, where the
rate jumps.

  probation excitation tension.csv
  probation excitation tension.csv --method savitzky-golay --csv smooth.csv --plot smooth.png
  probation excitation hdpe-2020/ --record grip-0.02 --method necking --report excitation.html
  probation excitation --compare                every method on histories whose rate is known; takes minutes

auto takes the strain as it is where it is clean (or the record has a rate of its own), and {DEFAULT} otherwise.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="strain, rate, and how well they are known", description=_DESCRIPTION)
    parser.add_argument(
        "file",
        metavar="FILE",
        nargs="?",
        help="a data file, each specimen of which is a record; or a campaign: its folder or campaign.toml",
    )
    parser.add_argument("--record", metavar="ID", action="append", help="only this record; may be repeated")
    parser.add_argument("--method", choices=METHODS, default="auto", help="how strain becomes strain and rate (auto)")
    parser.add_argument(
        "--csv",
        metavar="OUT.csv",
        type=output_file_or_stream,
        help="write time, strain, rate and standard errors; - is standard output",
    )
    parser.add_argument(
        "--compare",
        action="store_true",
        help="compare the methods on histories whose rate is known; takes minutes, --draws 1 a fifth of them",
    )
    parser.add_argument("--draws", metavar="N", type=whole_number(1), help="draws of the noise that are compared (5)")
    parser.add_argument("--seed", metavar="N", type=int, help="of the noise that is compared (0)")
    add_data_files(parser)
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    return _compare(options) if options.compare else _describe(options)


def _describe(options: argparse.Namespace) -> int:
    from probation.smoothing.answer import describe_excitation  # noqa: PLC0415 - see the package

    if options.file is None:
        raise InputError("found no file, expected FILE or --compare")
    if options.draws is not None or options.seed is not None:
        raise InputError("found --draws or --seed without --compare")
    if options.csv == "-" and options.json == "-":
        raise InputError("found both --csv - and --json -, expected one of them on standard output")
    records = _records(options)
    several = [name for name in ("csv", "plot") if getattr(options, name)]
    if several and len(records) > 1:
        names = ", ".join(record.id for record in records)
        raise InputError(
            f"{options.file}: found the records {names}, expected one with --{several[0]}; add --record ID"
        )
    with shown("excitation") as advance:
        answer = describe_excitation(records, options.method, source=Path(options.file).name, progress=advance)
    deliver(
        "" if options.csv == "-" else answer.summary(),
        [text_output("CSV", options.csv, answer.to_csv), *outputs_with_report(answer, options)],
    )
    return 0


def _records(options: argparse.Namespace) -> tuple[Record, ...]:
    """Those of a campaign, or of a data file that stands in for one."""
    path: str = options.file
    from probation.records.campaign import Campaign  # noqa: PLC0415

    try:
        campaign = campaign_at([path], options)
    except InputError as error:
        if not is_data_file(path):
            raise
        place = Path(path)
        campaign = Campaign(place.name, (_strain_alone(place, error, options),))
    return tuple(campaign.record(record_id) for record_id in options.record) if options.record else campaign.records


def _strain_alone(place: Path, refused: InputError, options: argparse.Namespace) -> Record:
    """A file of strain over time as a record without stress; `refused` says why it is no stress-strain record."""
    import numpy as np  # noqa: PLC0415 - see the package

    from probation.records.record import Record  # noqa: PLC0415
    from probation.records.strain_history import read_strain_history  # noqa: PLC0415

    try:
        history = read_strain_history(place, **reading_from(options))
    except InputError:
        raise refused from None
    return Record(
        place.name.split(".")[0],
        history.time,
        history.true_strain,
        np.zeros_like(history.time),
        history.strain_rate,
        file=place,
        warnings=(*history.warnings, f"strain alone was read: {refused}"),
    )


def _compare(options: argparse.Namespace) -> int:
    from probation.smoothing.comparison import DRAWS, compare  # noqa: PLC0415

    given = [name for name in ("file", "record", "csv", "report") if getattr(options, name)]
    if given or options.method != "auto":
        found = {"file": "FILE"}.get(given[0], f"--{given[0]}") if given else "--method"
        raise InputError(f"found {found} together with --compare, expected only --draws, --seed, --json and --plot")
    with shown("comparing") as advance:
        answer = compare(draws=options.draws or DRAWS, seed=options.seed or 0, progress=advance)
    deliver(answer.summary(), usual_outputs(answer, options))
    return 0
