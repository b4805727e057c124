"""The command line: arguments to calls, exceptions to one line and an exit status."""

from __future__ import annotations

import argparse
import os
import shlex
import sys
import traceback
import warnings
from functools import cache
from importlib.metadata import entry_points
from types import ModuleType
from typing import TYPE_CHECKING, NoReturn, TextIO

from probation import _interrupt
from probation._core import __version__
from probation._text import printed_escaped
from probation.commands import (
    certify,
    companion,
    crosscheck,
    demo,
    diagnose,
    excitation,
    export,
    field,
    fit,
    init,
    plan,
    preview,
    simulate,
    streams,
)
from probation.commands.delivery import described
from probation.commands.help_text import HelpFormatter
from probation.errors import ConvergenceError, InputError
from probation.histories.named import nearest
from probation.provenance import running

if TYPE_CHECKING:
    from collections.abc import Sequence

    from _typeshed import SupportsWrite

COMMANDS = (
    demo, preview, init, excitation, fit, companion, certify, diagnose, plan, crosscheck, simulate, export, field,
)  # fmt: skip
"""One module per command, in the order of the help: NAME, `add_parser` and `run`. A new command is one more here.

Packages beside this one add theirs by an entry point of the group `probation.commands`; one with the NAME of a command
here stands in its place.
"""

_DESCRIPTION = """\
Puts a constitutive law on probation: the modal (DNLR) law of semi-crystalline polymers, on your records.

  see it work              probation demo
  how a file is read       probation preview tension.csv
  a campaign of lab files  probation init tension-*.csv -o hdpe-2020
  strain rate, how sure    probation excitation tension.csv
  identify the law         probation fit hdpe-2020/ --report fit.html
  is the law intrinsic?    probation certify hdpe-2020/ --report cert.html
  what does it leave out?  probation diagnose hdpe-2020/ --report why.html
  what would tests tell?   probation plan --history ramp:rate=0.005,strain=2 \\
                               --noise 0.04 --set unrelaxed_modulus_MPa=3220 \\
                               --set tau_max_s=5.2 \\
                               --set hardening_modulus_MPa=2.5
  how far schemes agree    probation crosscheck hdpe-2020/
  simulate a test          probation simulate --history ramp:rate=0.005 \\
                               --set unrelaxed_modulus_MPa=3220 \\
                               --set tau_max_s=5.2 \\
                               --set hardening_modulus_MPa=2.5 -o ramp.csv
  into finite elements     probation export fit.json --format abaqus-umat
"""
_EPILOG = """\
probation COMMAND --help lists the options of a command, with examples.

A campaign is a folder with a campaign.toml and its records; `probation demo` writes three to look at.
Exit status: 0 done, whatever the verdict; 2 bad input, said in one line; 1 anything else.
PROBATION_DEBUG=1 shows where in the program an error arose.
"""

_DONE, _FAILED, _BAD_INPUT, _PIPE_CLOSED = 0, 1, 2, 141


class _Parser(argparse.ArgumentParser):
    """Says what is wrong with the arguments in one line; fails where its help cannot be written."""

    def _print_message(self, message: str, file: SupportsWrite[str] | None = None) -> None:
        """Its own takes no notice of a full disk; what it writes is the help and the version."""
        streams.put(message)

    def format_help(self) -> str:
        """Of this parser and, since they are of its class, of its commands."""
        self.formatter_class = HelpFormatter
        return super().format_help()

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}; see {self.prog} --help")


@cache
def commands() -> tuple[ModuleType, ...]:
    """The modules of all commands: those of this package, then those of others by name."""
    others = sorted(entry_points(group="probation.commands"), key=lambda entry: entry.name)
    modules = (*COMMANDS, *(entry.load() for entry in others))
    return tuple({command.NAME: command for command in modules}.values())


def build_parser() -> argparse.ArgumentParser:
    """The parser of all commands."""
    parser = _Parser(
        prog="probation",
        description=_DESCRIPTION,
        epilog=_EPILOG,
        allow_abbrev=False,
    )
    parser.add_argument("--version", action="version", version=f"probation {__version__}")
    subparsers = parser.add_subparsers(title="commands", metavar="COMMAND", dest="command", parser_class=_Parser)
    for command in commands():
        own = command.add_parser(subparsers)
        own.set_defaults(run=command.run)
    return parser


@printed_escaped()
def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command.

    Parameters
    ----------
    arguments : sequence of str, optional
        Those of the process if left out.

    Returns
    -------
    int
        Exit status: 0 done, 2 bad input, 1 otherwise; 130 interrupted, 141 where the reader of a pipe went away.
    """
    arguments = sys.argv[1:] if arguments is None else list(arguments)
    streams.open_closed()
    _tolerate_plain_terminals()
    os.environ["MPLBACKEND"] = "agg"  # pictures go to files; matplotlib cannot be loaded with a name it does not know
    try:
        _interrupt.loaded()
        with running(shlex.join(["probation", *arguments])), warnings.catch_warnings():
            warnings.showwarning = _show_warning
            status = _run(arguments)
            streams.put()
            return status
    except KeyboardInterrupt:
        streams.say("probation: interrupted")
        return _interrupt.INTERRUPTED
    except Exception as error:
        return _failed(error)


def _failed(error: Exception) -> int:
    """Say in one line what went wrong; the exit status."""
    match error:
        case InputError():
            return _tell(error, str(error), _BAD_INPUT)
        case ConvergenceError():
            return _tell(error, f"did not converge: {error}", _FAILED)
        case BrokenPipeError(filename=None):  # of standard output
            return _PIPE_CLOSED
        case OSError():
            return _tell(error, described(error), _FAILED)
    hint = "" if _debugging() else "; PROBATION_DEBUG=1 shows where"
    return _tell(error, f"unexpected {type(error).__name__}: {error}{hint}", _FAILED)


def _run(arguments: list[str]) -> int:
    names = [command.NAME for command in commands()]
    parser = build_parser()
    if not arguments:
        parser.print_help()
        return _DONE
    if not arguments[0].startswith("-") and arguments[0] not in names:
        raise InputError(f"found the unknown command {arguments[0]!r}; {nearest(arguments[0], names)}")
    try:
        options = parser.parse_args(arguments)
    except SystemExit:  # after --help or --version
        return _DONE
    if options.command is None:
        raise InputError(f"found no command; expected one of {', '.join(names)}")
    status: int = options.run(options)
    return status


def _tell(error: Exception, message: str, status: int) -> int:
    if _debugging():
        traceback.print_exception(error)
    streams.say(f"probation: {' '.join(message.split())}")
    return status


def _debugging() -> bool:
    return os.environ.get("PROBATION_DEBUG", "0") not in ("", "0")


def _show_warning(
    message: Warning | str,
    category: type[Warning],
    filename: str,
    lineno: int,
    file: TextIO | None = None,
    line: str | None = None,
) -> None:
    where = f" ({filename}:{lineno})" if _debugging() else ""
    streams.say(f"warning: {message}{where}")


def _tolerate_plain_terminals() -> None:
    """A terminal without these characters shows question marks rather than an error."""
    for stream in (sys.stdout, sys.stderr):
        reconfigure = getattr(stream, "reconfigure", None)
        if reconfigure is not None:
            reconfigure(errors="replace")


if __name__ == "__main__":
    sys.exit(main())
