"""``probation diagnose``: where the simulation departs from reality, why, and how far that can be mended."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from probation.commands.analysis_options import (
    add_effects,
    add_seed,
    add_threads,
    check_effects,
    effects_from_options,
    fraction,
    seconds,
)
from probation.commands.campaign_options import (
    add_campaign,
    add_data_files,
    add_held_out,
    campaign_at,
    campaign_from,
    with_held_out,
)
from probation.commands.delivery import (
    add_delivery,
    deliver,
    named_numbers,
    outputs_with_report,
    text_output,
)
from probation.commands.progress import in_parts, shown
from probation.commands.scheme_options import add_hold, add_scheme
from probation.errors import InputError
from probation.settings.detection import DETECTION

if TYPE_CHECKING:
    from probation.records.campaign import Campaign

NAME = "diagnose"

_DESCRIPTION = """\
What does the simulation leave out? The base law is fitted to the records with role "identify"; if what is left is more
than noise, the answer says

  where     in which records, and in which parts of them, the law departs from the measurement,
  which     physical effect or fault of the rig explains that, with a probability for each; also "no effect is needed"
            and "an effect outside the catalogue". What the data cannot discriminate is listed together,
  how far   the gap shrinks once the effect is added, on records that were held out too,

and which test would settle what is still open.

  probation diagnose hdpe-2020/
  probation diagnose hdpe-2020/ --held-out grip-0.02 --report diagnosis.html
  probation diagnose hdpe-2020/ --effects self_heating,damage,machine_compliance --json -
  probation diagnose --list-effects                     every effect that is known: physics, parameters, bounds
  probation diagnose hdpe-2020/ --isolability           what these tests could discriminate, whatever they show
  probation diagnose may/ --against march/              what changed since: the rig, the material, or nothing

In a first reading: the headline, the starred explanations, and "gap closed" of the held-out records.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="where, why and how far the law departs", description=_DESCRIPTION)
    add_campaign(parser, optional=True)
    add_data_files(parser)
    instead = parser.add_mutually_exclusive_group()
    instead.add_argument("--list-effects", action="store_true", help="list the effects that are known; no campaign")
    instead.add_argument(
        "--isolability",
        action="store_true",
        help="say which effects these tests could discriminate, from strain histories and noise alone",
    )
    instead.add_argument(
        "--against",
        metavar="REFERENCE",
        action="append",
        help="say what changed since that campaign of the same tests; a folder, or data files, given several times",
    )
    parser.add_argument(
        "--pair",
        metavar="ID=REFERENCE_ID",
        action="append",
        default=[],
        help="with --against: the reference of a record whose id is another there; may be given several times",
    )
    add_held_out(parser)
    add_effects(parser)
    add_scheme(parser, "sa3")
    add_hold(parser)
    add_seed(parser)
    add_threads(parser)
    parser.add_argument(
        "--budget",
        metavar="SECONDS",
        type=seconds,
        help="give the best answer that is found in so many seconds, and say what was not tried (no limit)",
    )
    parser.add_argument(
        "--tolerance",
        metavar="FRACTION",
        type=fraction,
        default=DETECTION.tolerance,
        help="gap, as a fraction of a record's largest stress, below which it does not matter "
        f"({DETECTION.tolerance:g})",
    )
    add_delivery(parser)
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    names = effects_from_options(options)
    if options.pair and not options.against:
        raise InputError("found --pair without --against, expected both or neither")
    if options.against:
        return _change(options, names)
    check_effects(names)
    if options.list_effects:
        return _list_effects(options, names)
    if not options.campaign:
        raise InputError("found no campaign, expected CAMPAIGN or --list-effects")
    held = named_numbers(options.hold, "--hold")
    campaign = with_held_out(campaign_from(options), options.held_out)
    if options.isolability:
        return _isolability(options, campaign, held, names)
    from probation.diagnosis.diagnose import diagnose  # noqa: PLC0415 - see the package

    with shown(f"diagnosis of {campaign.name}") as advance:
        answer = diagnose(
            campaign,
            options.scheme,
            effects=names,
            hold=held,
            seed=options.seed,
            threads=options.threads,
            budget=options.budget,
            tolerance=options.tolerance,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0


def _change(options: argparse.Namespace, names: list[str] | None) -> int:
    for name in ("hold", "held_out"):
        if getattr(options, name):
            raise InputError(f"found --{name.replace('_', '-')} with --against, expected neither or one of them")
    if not options.campaign:
        raise InputError("found no campaign, expected CAMPAIGN together with --against")
    pairs: dict[str, list[str]] = {}
    for entry in options.pair:
        record, equals, other = (part.strip() for part in entry.partition("="))
        if not equals or not record or not other:
            raise InputError(f"--pair: found {entry!r}, expected ID=REFERENCE_ID")
        pairs.setdefault(record, []).append(other)
    from probation.comparison.compare import compare  # noqa: PLC0415 - see the package

    campaign, reference = campaign_from(options), campaign_at(options.against, options)
    with shown(f"{campaign.name} against {reference.name}") as advance:
        answer = compare(
            campaign,
            reference,
            options.scheme,
            pairs=pairs or None,
            effects=names,
            seed=options.seed,
            threads=options.threads,
            budget=options.budget,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0


def _isolability(
    options: argparse.Namespace, campaign: Campaign, held: dict[str, float], names: list[str] | None
) -> int:
    from probation.diagnosis.isolability import campaign_isolability  # noqa: PLC0415 - see the package

    with shown(f"what {campaign.name} could discriminate") as advance:
        answer = campaign_isolability(
            campaign,
            options.scheme,
            effects=names,
            hold=held,
            threads=options.threads,
            progress=in_parts(advance),
        )
    deliver(answer.summary(), outputs_with_report(answer, options))
    return 0


def _list_effects(options: argparse.Namespace, names: list[str] | None) -> int:
    from probation.answers import json_answer  # noqa: PLC0415 - see the package
    from probation.effects.listing import catalogue_json, catalogue_table  # noqa: PLC0415
    from probation.effects.registry import effects  # noqa: PLC0415

    for option in ("plot", "report"):
        if getattr(options, option):
            raise InputError(f"found --{option} with --list-effects, expected --json or nothing")
    if options.campaign:
        raise InputError(f"found the campaign {options.campaign[0]!r} with --list-effects, expected none")
    chosen = effects(names)
    table = "" if options.json == "-" else catalogue_table(chosen).rstrip()

    def to_json() -> str:
        return json_answer("probation.effects/1", {"effects": catalogue_json(chosen)})

    deliver(table, [text_output("JSON", options.json, to_json)])
    return 0
