"""``probation certify``: the probation test."""

from __future__ import annotations

import argparse
import math
from dataclasses import replace
from typing import TYPE_CHECKING

from probation.commands.campaign_options import add_campaign, add_control, campaign_from
from probation.commands.delivery import add_delivery, deliver, deliver_report, named_numbers
from probation.commands.progress import shown
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.records import Campaign

NAME = "certify"

_DESCRIPTION = """\
The probation test: is the law intrinsic to the material? Its parameters are identified on the records with role
"identify"; the held-out ones are predicted with nothing adjusted. Then each record is identified alone, to see which
parameter keeps its value. The answer is a certificate: intrinsic, intrinsic with exceptions, or not intrinsic.

  probation certify hdpe-2020/
  probation certify hdpe-2020/ --held-out grip-0.02 --held-out grip-0.08 --report certificate.html
  probation certify tension.csv --control displacement-rate        (each specimen predicted from the others)
  probation certify hdpe-2020/ --tolerance 0.02 --json -
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="the probation test: is the law intrinsic?", description=_DESCRIPTION)
    add_campaign(parser)
    add_control(parser)
    parser.add_argument(
        "--held-out",
        metavar="ID",
        action="append",
        default=[],
        help="predict this record and identify on all others, whatever their roles; may be given several times",
    )
    parser.add_argument(
        "--tolerance",
        metavar="FRACTION",
        type=_fraction,
        default=0.05,
        help="systematic error that is let pass, as a fraction of a record's largest stress (0.05)",
    )
    parser.add_argument("--scheme", choices=("be2", "sa2", "sa3"), default="be2", help="time integration (be2)")
    parser.add_argument(
        "--hold",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="hold a parameter: unrelaxed_modulus_MPa, tau_max_s, alpha, hardening_modulus_MPa",
    )
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.certificate import certify  # noqa: PLC0415 - see the package

    held = named_numbers(options.hold, "--hold")
    campaign = _with_roles(campaign_from(options), options.held_out)
    with shown(f"probation test on {campaign.name}") as advance:
        answer = certify(
            campaign,
            options.scheme,
            tolerance=options.tolerance,
            hold=held,
            progress=lambda part: advance(round(100 * part), 100, ""),
        )
    deliver(answer, options)
    deliver_report(answer, options)
    return 0


def _with_roles(campaign: Campaign, held_out: list[str]) -> Campaign:
    """The campaign with those records held out and all others to identify on; as it is where none is named."""
    if not held_out:
        return campaign
    for name in held_out:
        try:
            campaign.record(name)
        except InputError as error:
            raise InputError(f"--held-out: {error}") from None
    if len(set(held_out)) == len(campaign.records):
        raise InputError("--held-out: found every record, expected at least one left to identify on")
    roles = {record.id: "held-out" if record.id in held_out else "identify" for record in campaign.records}
    return replace(campaign, records=tuple(replace(each, role=roles[each.id]) for each in campaign.records))


def _fraction(text: str) -> float:
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < 1.0:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a fraction between 0 and 1, such as 0.05")
    return value
