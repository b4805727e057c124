"""``probation init``: from the files of a laboratory to a campaign."""

from __future__ import annotations

import argparse
import sys
from contextlib import nullcontext
from typing import TYPE_CHECKING, Any

from probation._text import printable
from probation.commands.campaign_options import CONTROLS
from probation.commands.delivery import deliver, output_folder
from probation.commands.progress import shown
from probation.commands.reading_options import add_reading, reading_from
from probation.commands.streams import say
from probation.errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.records.initial.questions import Question

NAME = "init"

_ROLES = ("identify", "held-out")
_LISTS = ("column", "unit", "specimen", "strain_column", "strain_unit", "control", "role")
_TEXTS = ("profile", "sheet", "test_rate", "strain_file")
_DESCRIPTION = """\
Make a campaign of the files of a laboratory: a folder with a commented campaign.toml, the files, and records.html with
a plot of every record.

  probation init tension-*.csv -o hdpe-2020
  probation init raw.csv export.xlsx -o hdpe-2020 --yes --specimen area_mm2=40 --specimen gauge_length_mm=50
  probation init a.csv b.csv -o hdpe-2020 --specimen a.csv:area_mm2=40 --specimen b.csv:area_mm2=38.5 \\
      --role b.csv:held-out

It knows the files of Instron Bluehill, ZwickRoell testXpert, MTS TestSuite, Shimadzu TRAPEZIUM, Kammrath & Weiss and
HBM catman, and tables with English, German, French, Italian or Spanish headings; each specimen of a file becomes a
record. What no file says (the section of a specimen, true or engineering) is asked, with a default where there is
one; without a terminal, or with --yes, defaults are taken, and one line says which option gives what has none.

Of several files, --specimen is for those that state no dimensions; --specimen FILE:…, or --specimen with one file
alone, wins over what the file states.
Files are copied, so that the folder can be moved, archived and sent; --link names them where they are.
"""


def add_parser(subparsers: argparse._SubParsersAction[argparse.ArgumentParser]) -> argparse.ArgumentParser:
    """Add the command."""
    parser = subparsers.add_parser(NAME, help="make a campaign of the files of a laboratory", description=_DESCRIPTION)
    parser.add_argument("files", metavar="FILE", nargs="+", help="what probation preview reads")
    parser.add_argument(
        "-o", "--output", metavar="FOLDER", type=output_folder, required=True, help="the campaign; made if need be"
    )
    parser.add_argument("--name", metavar="NAME", help="of the campaign (the folder's)")
    parser.add_argument("--yes", action="store_true", help="ask nothing: take every default")
    parser.add_argument("--link", action="store_true", help="name the files where they are instead of copying them")
    group = add_reading(parser)
    group.description = (
        f"{group.description} FILE: before a value says it of that file alone: --specimen a.csv:area_mm2=40"
    )
    group.add_argument(
        "--control",
        metavar="HOW",
        action="append",
        default=[],
        help=f"how the tests were driven: {', '.join(CONTROLS)} (guessed from the strain)",
    )
    group.add_argument(
        "--role", metavar="ROLE", action="append", default=[], help="identify, or held-out: never fitted (identify)"
    )
    return parser


def run(options: argparse.Namespace) -> int:
    """Run the command."""
    from pathlib import Path  # noqa: PLC0415 - see the package

    from probation.records.initial.init_campaign import init_campaign  # noqa: PLC0415

    names = list(dict.fromkeys(Path(file).name for file in options.files))
    general, single = _parted(options, names)
    asks = not options.yes and sys.stdin is not None and sys.stdin.isatty()
    with nullcontext() if asks else shown("making the campaign") as advance:  # a bar would hide the questions
        made = init_campaign(
            options.files,
            options.output,
            name=options.name,
            control=_choice(general.control, "--control"),
            role=_choice(general.role, "--role"),
            link=options.link,
            by_file={name: _said(given) for name, given in single.items()},
            ask=_Asking() if asks else None,
            progress=advance,
            **reading_from(general),
        )
    deliver(made.summary(), [])
    return 0


class _Asking:
    """Questions on the terminal; an answer given once is the default of the same question about the next file."""

    def __init__(self) -> None:
        self._answers: dict[str, str] = {}

    def __call__(self, question: Question) -> str:
        """Ask until there is an answer."""
        default = question.default or self._answers.get(question.key, "")
        choices = f" ({', '.join(question.choices)})" if question.choices else ""
        offered = f" [{default}]" if default else ""
        while True:
            asked = f"{printable(question.file)}: {printable(question.text)}{choices}{offered}: "
            print(asked, end="", file=sys.stderr, flush=True)
            line = sys.stdin.readline()
            if not line:
                raise question.unanswered()
            answer = line.strip() or default
            if answer and (not question.choices or answer in question.choices):
                self._answers[question.key] = answer
                return answer
            say(f"expected {', '.join(question.choices) or 'an answer'}")


def _parted(
    options: argparse.Namespace, names: Sequence[str]
) -> tuple[argparse.Namespace, dict[str, argparse.Namespace]]:
    """The options for all files, and those of ``FILE:value`` for single ones."""
    general = argparse.Namespace(**vars(options))
    single: dict[str, argparse.Namespace] = {}

    def own(entry: str | None) -> tuple[argparse.Namespace, str] | None:
        """The options of the file that an entry begins with, and the rest of the entry."""
        name = next((name for name in names if (entry or "").startswith(f"{name}:")), None)
        if name is None or entry is None:
            return None
        return single.setdefault(name, _nothing_said()), entry[len(name) + 1 :]

    for option in _LISTS:
        setattr(general, option, [])
        for entry in getattr(options, option):
            found = own(entry)
            where, value = found or (general, entry)
            getattr(where, option).append(value)
    for option in _TEXTS:
        if (found := own(getattr(options, option))) is not None:
            setattr(found[0], option, found[1])
            setattr(general, option, None)
    return general, single


def _nothing_said() -> argparse.Namespace:
    nothing = dict.fromkeys((*_TEXTS, "specimen_index", "strain_gauge_length", "strain_shift"))
    return argparse.Namespace(**nothing, **{option: [] for option in _LISTS})


def _said(given: argparse.Namespace) -> dict[str, Any]:
    said: dict[str, Any] = {key: value for key, value in reading_from(given).items() if value}
    for option in ("control", "role"):
        choice = _choice(getattr(given, option), f"--{option}")
        if choice is not None:
            said[option] = choice
    return said


def _choice(entries: Sequence[str], option: str) -> str | None:
    known = CONTROLS if option == "--control" else _ROLES
    if len(entries) > 1:
        raise InputError(
            f"{option}: found {' and '.join(entries)}, expected one for all files; FILE:{entries[1]} "
            "says it of one file"
        )
    for entry in entries:
        if entry not in known:
            raise InputError(f"{option}: found {entry!r}, expected {', '.join(known)}, or FILE:{known[0]} of one file")
    return entries[0] if entries else None
