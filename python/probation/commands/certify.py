"""``probation certify``: the probation test."""

from __future__ import annotations

import argparse

from probation.commands.analysis_options import fraction
from probation.commands.campaign_options import add_campaign, add_data_files, add_held_out, campaign_from, with_held_out
from probation.commands.delivery import add_delivery, deliver, named_numbers, outputs_with_report
from probation.commands.progress import in_parts, shown
from probation.commands.scheme_options import add_hold, add_scheme
from probation.settings.certificate import CERTIFICATE

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
    add_data_files(parser)
    add_held_out(parser)
    parser.add_argument(
        "--tolerance",
        metavar="FRACTION",
        type=fraction,
        default=CERTIFICATE.tolerance,
        help="systematic error that is let pass, as a fraction of a record's largest stress "
        f"({CERTIFICATE.tolerance:g})",
    )
    add_scheme(parser)
    add_hold(parser)
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.certificate.certify import certify  # noqa: PLC0415 - see the package

    held = named_numbers(options.hold, "--hold")
    campaign = with_held_out(campaign_from(options), options.held_out)
    with shown(f"probation test on {campaign.name}") as advance:
        answer = certify(
            campaign,
            options.scheme,
            tolerance=options.tolerance,
            hold=held,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0
