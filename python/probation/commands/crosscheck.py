"""``probation crosscheck``: how far the schemes agree."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from probation.commands.delivery import add_delivery, deliver, outputs_with_report, warn
from probation.commands.law_options import make_law, read_settings
from probation.commands.progress import shown
from probation.errors import InputError

if TYPE_CHECKING:
    from probation.law.modal import Law
    from probation.records.campaign import Campaign

NAME = "crosscheck"

_DESCRIPTION = """\
Run every scheme (be2 from both starts, sa2, sa3, exact, cvode, and eq. (7) on a ramp) on the same records: largest
error, observed order, time per solve, CVODE's statistics.

  probation crosscheck                          on the embedded synthetic data of experiments 1 and 3
  probation crosscheck hdpe-2020/ --record ramp1 --report crosscheck.html

On a campaign the law's parameters are those of --set, then the campaign's law.fixed; what is left is identified.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="how far the schemes agree: error, order, time", description=_DESCRIPTION)
    parser.add_argument("campaign", metavar="CAMPAIGN", nargs="?", help="a folder with a campaign.toml, or that file")
    parser.add_argument("--record", metavar="ID", action="append", help="only this record; may be repeated")
    parser.add_argument(
        "--set",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help="a parameter of the law: unrelaxed_modulus_MPa, hardening_modulus_MPa, tau_max_s or alpha",
    )
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.records.campaign import Campaign  # noqa: PLC0415
    from probation.schemes.crosscheck import crosscheck  # noqa: PLC0415 - see the package

    if options.campaign is None:
        if options.record or options.set:
            raise InputError("found --record or --set without a campaign, expected CAMPAIGN before them")
        with shown("cross-checking") as advance:
            answer = crosscheck(progress=advance)
    else:
        with shown(f"reading {options.campaign}"):
            campaign = Campaign.load(options.campaign)
        records = [campaign.record(record_id) for record_id in options.record] if options.record else campaign.records
        with shown("cross-checking") as advance:
            answer = crosscheck(records, _law(campaign, read_settings(options.set)), progress=advance)
        for warning in campaign.warnings:
            warn(warning)
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0


def _law(campaign: Campaign, settings: dict[str, float]) -> Law:
    """The campaign's law, what is neither set nor held identified."""
    from probation.identify.fit import fit  # noqa: PLC0415
    from probation.law.companion import from_settings  # noqa: PLC0415

    held = {**campaign.law.fixed, **settings}
    relation = from_settings(campaign.law.companion)
    if {"unrelaxed_modulus_MPa", "hardening_modulus_MPa", "tau_max_s" if relation is None else "alpha"} <= set(held):
        spectrum = {"modes": float(campaign.law.modes), "decades": campaign.law.decades}
        if campaign.law.accuracy is not None:
            spectrum["accuracy"] = campaign.law.accuracy
        return make_law({**spectrum, **held}, relation)
    return fit(campaign, hold=settings, gap=False).law
