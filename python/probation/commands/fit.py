"""``probation fit``: the law's parameters from records."""

from __future__ import annotations

import argparse

from probation.commands.campaign_options import add_campaign, add_data_files, campaign_from
from probation.commands.delivery import add_delivery, deliver, named_numbers, outputs_with_report
from probation.commands.progress import in_parts, shown
from probation.commands.scheme_options import add_hold, add_scheme, add_start, add_substeps
from probation.law.schemes import scheme_of
from probation.smoothing.methods import METHODS as EXCITATIONS

NAME = "fit"

_METHODS = ("least-squares", "variable-projection", "simplex")
_WEIGHTINGS = ("auto", "plain", "strain-noise", "strain-noise-frozen")
_INTERVALS = ("standard-error", "profile")

_DESCRIPTION = """\
Identify the law on the records of a campaign: E_u, tau_max (or alpha, with a companion relation) and G, what is
known about them, and what is left.

  probation fit hdpe-2020/
  probation fit hdpe-2020/campaign.toml --hold unrelaxed_modulus_MPa=3220 --report fit.html
  probation fit hdpe-2020/ --scheme sa3 --json - > fit.json
  probation fit hdpe-2020/ --weighting strain-noise --intervals profile --report fit.html
  probation fit 0d01_3d0.csv 0d03_3d0.csv 0d05_3d0.csv --control displacement-rate
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="identify the law on records", description=_DESCRIPTION)
    add_campaign(parser)
    add_data_files(parser)
    add_scheme(parser)
    add_start(parser)
    add_substeps(parser)
    parser.add_argument("--method", choices=_METHODS, default="least-squares", help="of identification (least-squares)")
    add_hold(parser, "; wins over the campaign's law.fixed")
    parser.add_argument(
        "--excitation",
        choices=EXCITATIONS,
        default="auto",
        help="whether, and how, the strain is smoothed: auto does so where it is noisy",
    )
    parser.add_argument(
        "--weighting",
        choices=_WEIGHTINGS,
        default="auto",
        help="what the residuals are weighed for: plain, white noise of the stress; strain-noise, also that of the "
        "strain as the law propagates it to the stress; auto, that where it matters, and autocorrelated stress noise; "
        "strain-noise-frozen is biased, for comparison",
    )
    parser.add_argument(
        "--intervals",
        choices=_INTERVALS,
        default="standard-error",
        help="where the 95 %% intervals come from; profile follows the likelihood (slower)",
    )
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.identify.fit import fit  # noqa: PLC0415 - see the package

    held = named_numbers(options.hold, "--hold")
    campaign = campaign_from(options)
    with shown(f"identifying on {campaign.name}") as advance:
        answer = fit(
            campaign,
            scheme_of(options.scheme, options.start),
            method=options.method,
            hold=held,
            excitation=options.excitation,
            substeps=options.substeps,
            weighting=options.weighting,
            intervals=options.intervals,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0
