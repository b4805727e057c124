"""``probation companion``: the relaxation time from the strain rate."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from probation.commands.campaign_options import add_data_files, campaign_at, is_data_file
from probation.commands.delivery import (
    Output,
    Reportable,
    add_delivery,
    deliver,
    output_folder,
    outputs_with_report,
    text_output,
)
from probation.commands.progress import shown
from probation.commands.scheme_options import add_scheme
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Callable

    from probation.calibration.rate_table import RateTable
    from probation.calibration.result import Calibration
    from probation.records.campaign import Campaign

NAME = "companion"

_FORMS = ("auto", "weissenberg", "exponential", "power", "table")

_DESCRIPTION = """\
Calibrate the companion relation: how tau_max depends on the strain rate, eqs. (10)-(12), with the uncertainty that
later predictions carry.

  probation companion times.csv --form weissenberg           a table with the headings rate_per_s,tau_max_s[,se_s]
  probation companion hdpe-ramps/ --toml                     ramps at several rates; prints [law.companion]
  probation companion hdpe-ramps/ --apply hdpe-calibrated/   the campaign with that relation, ready for fit and certify
  probation companion 0d01.csv 0d03.csv 0d05.csv --control displacement-rate

Records at nearly constant rates are fitted one by one with a constant tau_max, and the relation is regressed on what
they give (by-rate); where a rate is not constant its parameters are identified on all records at once (direct). Among
the forms the data choose: each rate is left out in turn and predicted from the others.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="tau_max from the strain rate, calibrated", description=_DESCRIPTION)
    parser.add_argument(
        "source",
        metavar="CAMPAIGN",
        nargs="*",
        help="a folder with a campaign.toml, or that file; a table rate_per_s,tau_max_s[,se_s]; or data files",
    )
    parser.add_argument(
        "--form",
        choices=_FORMS,
        default="auto",
        help="weissenberg is eq. (11), exponential (12); auto takes the one that predicts rates left out best",
    )
    parser.add_argument(
        "--route",
        choices=("auto", "by-rate", "direct"),
        default="auto",
        help="each record alone, or all at once through the law; auto goes by whether the rates are constant",
    )
    parser.add_argument(
        "--modulus",
        choices=("shared", "free"),
        default="shared",
        help="E_u: one for all records (default; law.fixed wins), or each record its own (by-rate only)",
    )
    parser.add_argument(
        "--hardening",
        choices=("by-record", "shared"),
        default="by-record",
        help="G in the direct route: each record its own (default), or one for all",
    )
    add_scheme(parser, "sa3")
    add_data_files(parser)
    add_delivery(parser)
    group = parser.add_argument_group("use")
    group.add_argument("--toml", action="store_true", help="print [law.companion] alone, to paste into a campaign.toml")
    group.add_argument(
        "--apply", metavar="OUT_FOLDER", type=output_folder, help="write the campaign with this relation there"
    )
    return parser


class Presentable(Reportable, Protocol):
    """What can be delivered with all that the command offers."""

    def summary(self) -> str:
        """The text for the terminal."""


def run(
    options: argparse.Namespace,
    table: RateTable | None = None,
    presented: Callable[[Calibration], Presentable] = lambda calibration: calibration,
) -> int:
    """Run the command, on `table` if there is one; what is delivered of the answer is what `presented` makes of it."""
    from probation.calibration.calibrate import calibrate_companion  # noqa: PLC0415 - see the package
    from probation.calibration.rate_table import RateTable  # noqa: PLC0415 - see the package

    if options.toml and options.json == "-":
        raise InputError("found both --toml and --json -, expected one of them on standard output")
    source = _source(options) if table is None else table
    if options.apply and isinstance(source, RateTable):
        raise InputError("--apply: found a table, expected a campaign; --toml prints what to paste into one")
    name = source.source if isinstance(source, RateTable) else source.name
    with shown(f"calibrating on {name}") as advance:
        answer = calibrate_companion(
            source,
            form=options.form,
            route=options.route,
            modulus=options.modulus,
            hardening=options.hardening,
            scheme=options.scheme,
            progress=advance,
        )
        presentable = presented(answer)
        text = presentable.summary()

    def apply(place: str) -> str:
        assert not isinstance(source, RateTable)
        return f"campaign {answer.apply(source).save(place)}"

    relation = text_output("[law.companion]", "-" if options.toml else None, answer.toml)
    deliver(text, [relation, *outputs_with_report(presentable, options), Output("campaign", options.apply, apply)])
    return 0


def _source(options: argparse.Namespace) -> Campaign | RateTable:
    """A table, a campaign, or data files that stand in for one."""
    from probation.calibration.table_file import read_rate_table  # noqa: PLC0415

    if not options.source:
        raise InputError("found no CAMPAIGN, expected a campaign, a table or data files")
    if len(options.source) == 1 and is_data_file(options.source[0]):
        table = read_rate_table(Path(options.source[0]))
        if table is not None:
            return table
    return campaign_at(options.source, options)
