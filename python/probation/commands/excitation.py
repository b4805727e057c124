"""``probation excitation``: strain, rate, and how well they are known."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from probation.commands.campaign_options import add_data_files, campaign_at, is_data_file
from probation.commands.delivery import (
    add_delivery,
    deliver,
    output_file_or_stream,
    outputs_with_report,
    text_output,
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
    add_data_files(parser)
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.smoothing.answer import describe_excitation  # noqa: PLC0415 - see the package

    if options.file is None:
        raise InputError("found no file, expected FILE")
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
