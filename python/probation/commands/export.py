"""``probation export``: the identified law for finite-element codes."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import TYPE_CHECKING

from probation._files import make_folder
from probation.commands.campaign_options import add_data_files, campaign_at
from probation.commands.delivery import Output, add_json, deliver, output_file, output_folder, text_output, warn
from probation.commands.law_options import add_law_options, law_from_options
from probation.commands.progress import in_parts, shown
from probation.commands.streams import put
from probation.errors import InputError
from probation.histories.named import nearest

if TYPE_CHECKING:
    from probation.exporting.result import Export
    from probation.identify.result import Fit
    from probation.law.modal import Law

NAME = "export"

_ALL = "all"

_DESCRIPTION = """\
Write an identified law for a finite-element code. Every file is read back and solved again; the error against the law
stands in its header.

  probation export hdpe-2020/ --format abaqus-umat -o hdpe.inp           identifies, then writes the whole law
  probation export fit.json --format calculix --accuracy 1e-3            of what fit --json wrote, with 9 modes for 50
  probation export fit.json --format ansys-prony --rate 1e-3             the linear part, tau_max as at 1e-3 1/s
  probation export fit.json --format ls-dyna-mat-024 --rates 1e-4,1e-3,1e-2 --strain 1.2
  probation export --set unrelaxed_modulus_MPa=3220 --set hardening_modulus_MPa=1.8 \\
      --companion weissenberg:0.00464,0.0367 --format all --rate 1e-3 --folder cards/
  probation export --list-formats

What each keeps: user materials (abaqus-umat, calculix, mgis, c) the whole law, through the routines that come with
probation; Prony series its linear part at one rate, small strains only; tables by rate (abaqus-plastic,
ls-dyna-mat-024) monotonic loading only. Where a format cannot represent the law, it is not written, and one line says
why. Units: MPa, s, mm, t.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="the law for finite-element codes", description=_DESCRIPTION)
    parser.add_argument(
        "source",
        metavar="SOURCE",
        nargs="*",
        help="a campaign or data files, identified first, or the JSON that fit --json wrote; or none, with --set",
    )
    add_data_files(parser)
    add_law_options(parser)
    group = parser.add_argument_group("format")
    group.add_argument("--format", metavar="NAME", action="append", default=[], help="which; several, or all, too")
    group.add_argument("--list-formats", action="store_true", help="list their names")
    group.add_argument("--rate", metavar="R", type=float, help="strain rate of a Prony series [1/s]")
    group.add_argument("--rates", metavar="R,R,…", type=_numbers, help="strain rates of tables and checks [1/s]")
    group.add_argument("--strain", metavar="E", type=float, default=1.5, help="largest true strain of them (1.5)")
    group.add_argument("--bulk-modulus", metavar="MPA", type=float, help="100 times E_u / 3 if left out")
    group.add_argument("--density", metavar="T_PER_MM3", type=float, default=9.5e-10, help="9.5e-10, polyethylene")
    group.add_argument(
        "--stress-tolerance",
        metavar="MPA",
        type=float,
        default=0.0,
        help="user materials ask for smaller increments where the stress errs by more (0: never)",
    )
    group.add_argument("--name", metavar="NAME", default="probation", help="of the material (probation)")
    group = parser.add_argument_group("fewer modes")
    group.add_argument("--accuracy", metavar="A", type=float, help="refit; the stress errs by no more: 1e-3, 9 modes")
    group.add_argument("--modes", metavar="N", type=int, help="refit with at most so many; its error is reported")
    group = parser.add_argument_group("output")
    group.add_argument(
        "-o", "--output", metavar="FILE", type=output_file, help="of one format; standard output if left out"
    )
    group.add_argument("--folder", metavar="FOLDER", type=output_folder, help="of several; each under its own name")
    add_json(group, "the errors found")
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from probation.exporting.formats import FORMATS  # noqa: PLC0415 - see the package
    from probation.exporting.result import Exports  # noqa: PLC0415

    if options.list_formats:
        width = max(map(len, FORMATS))
        put("".join(f"{name:<{width}}  {form.what}\n" for name, form in FORMATS.items()))
        return 0
    names = _formats(options, list(FORMATS))
    exports = _exports(options, names)
    to_standard_output = options.output is None and options.folder is None
    if to_standard_output:
        outputs = [] if options.json == "-" else [text_output("file", "-", lambda: exports[0].text)]
    elif options.folder is None:
        outputs = [_file_output(exports[0], options.output)]
    else:
        outputs = [_file_output(exported, options.folder, into=True) for exported in exports]
    deliver(
        "\n".join(exported.summary() for exported in exports),
        [*outputs, text_output("JSON", options.json, Exports(tuple(exports)).to_json)],
    )
    return 0


def _file_output(export: Export, place: str, *, into: bool = False) -> Output:
    """One file, by its name or `into` a folder."""

    def write(target: str) -> str:
        return f"file {export.save(make_folder(target) if into else target)}"

    return Output("file", place, write)


def _formats(options: argparse.Namespace, known: list[str]) -> list[str]:
    """The formats that are asked for.

    Raises
    ------
    InputError
        If one is unknown, or several would go to one file.
    """
    if not options.format:
        raise InputError(f"--format: found none, expected one of {', '.join(known)}, or {_ALL}")
    for name in options.format:
        if name not in (*known, _ALL):
            raise InputError(f"--format: found {name!r}; {nearest(name, [*known, _ALL])}")
    names = known if _ALL in options.format else list(dict.fromkeys(options.format))
    if options.output is not None and options.folder is not None:
        raise InputError("found both -o and --folder, expected one of them")
    if len(names) > 1 and options.folder is None:
        raise InputError(f"--format: found {len(names)} formats and no --folder, expected one to write them into")
    return names


def _exports(options: argparse.Namespace, names: list[str]) -> list[Export]:
    """Each format; among all, those that can represent the law.

    Raises
    ------
    InputError
        If none can, or one that was named cannot.
    """
    from probation.exporting.exporting import export  # noqa: PLC0415
    from probation.exporting.source import law_and_source  # noqa: PLC0415

    source = _source(options)
    law_and_source(source)  # complains once, not for every format
    found, refusal = [], None
    for name in names:
        try:
            one = export(
                source,
                name,
                name=options.name,
                rate=options.rate,
                rates=options.rates,
                strain=options.strain,
                bulk_modulus=options.bulk_modulus,
                density=options.density,
                accuracy=options.accuracy,
                modes=options.modes,
                stress_tolerance=options.stress_tolerance,
            )
        except InputError as error:
            if _ALL not in options.format:
                raise
            warn(f"{name} is left out: {error}")
            refusal = error
            continue
        found.append(one)
    if not found and refusal is not None:
        raise refusal
    return found


def _source(options: argparse.Namespace) -> Law | Fit | Path:
    """A law by ``--set``, a fit that was written, or one made here."""
    from probation.identify.fit import fit  # noqa: PLC0415

    if not options.source:
        if not options.set:
            raise InputError("found neither SOURCE nor --set, expected a campaign, the JSON of a fit, or parameters")
        return law_from_options(options)
    if options.set or options.companion:
        raise InputError("found SOURCE together with --set or --companion, expected one of them")
    if len(options.source) == 1 and Path(options.source[0]).suffix.lower() == ".json":
        return Path(options.source[0])
    campaign = campaign_at(options.source, options)
    with shown(f"identifying on {campaign.name}") as advance:
        return fit(campaign, gap=False, progress=in_parts(advance))


def _numbers(text: str) -> list[float]:
    try:
        return [float(part) for part in text.split(",")]
    except ValueError:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected numbers between commas") from None
