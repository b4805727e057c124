"""Where an answer goes: the terminal, and the files that were asked for."""

from __future__ import annotations

import argparse
import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Protocol, TextIO

from probation._files import write_whole
from probation._text import raw_stream
from probation.errors import InputError

if TYPE_CHECKING:
    from matplotlib.figure import Figure

PLOT_ENDINGS = (".png", ".svg", ".pdf")


class Answer(Protocol):
    """What every result can do."""

    def summary(self) -> str:
        """The verdict, then numbers, as text."""

    def plot(self) -> Figure:
        """The result as a figure."""

    def to_json(self) -> str:
        """The result as JSON text."""


class Reportable(Answer, Protocol):
    """What a result with a page can do, too."""

    def report(self, path: str) -> object:
        """Write the page."""


def add_delivery(parser: argparse.ArgumentParser, *, report: bool = True) -> None:
    """Add ``--json``, ``--plot`` and ``--report``."""
    group = parser.add_argument_group("output")
    group.add_argument("--json", metavar="FILE", help="write the answer as JSON; - is standard output, and alone there")
    if report:
        group.add_argument("--report", metavar="FILE.html", help="write one self-contained HTML page")
    group.add_argument("--plot", metavar="FILE", type=plot_file, help="save the plot, as .png, .svg or .pdf")


def deliver(answer: Answer, options: argparse.Namespace) -> None:
    """Print the summary and write the files; with ``--json -`` only JSON goes to standard output."""
    tell(answer.summary(), sys.stderr if options.json == "-" else sys.stdout)
    deliver_files(answer, options)


def tell(summary: str, stream: TextIO) -> None:
    """Print a summary, its first line, the verdict, in bold on a terminal."""
    verdict, newline, rest = summary.partition("\n")
    if stream.isatty() and "NO_COLOR" not in os.environ:
        bold = raw_stream(stream)
        bold.write("\x1b[1m")
        stream.write(verdict)
        bold.write("\x1b[0m")
        verdict = ""
    print(verdict + newline + rest, file=stream)


def deliver_files(answer: Answer, options: argparse.Namespace) -> None:
    """Write the files that were asked for, and say so on standard error."""
    if options.json == "-":
        sys.stdout.write(answer.to_json())
    elif options.json:
        write_whole(options.json, answer.to_json())
        said("JSON", options.json)
    if options.plot:
        from probation.report.figures import save_figure  # noqa: PLC0415 - matplotlib is slow to load

        save_figure(answer.plot(), options.plot)
        said("plot", options.plot)


def deliver_report(answer: Reportable, options: argparse.Namespace) -> None:
    """Write the page, if it was asked for."""
    if options.report:
        answer.report(options.report)
        said("report", options.report)


def said(what: str, path: str | Path) -> None:
    """Tell, on standard error, that a file was written."""
    print(f"wrote {what} {path}", file=sys.stderr)


def warn(text: str) -> None:
    """Tell a warning on standard error."""
    print(f"warning: {text}", file=sys.stderr)


def plot_file(text: str) -> str:
    """Check the ending of a plot before anything is computed."""
    if Path(text).suffix.lower() not in PLOT_ENDINGS:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a file that ends in {', '.join(PLOT_ENDINGS)}")
    return text


def named_numbers(entries: list[str], option: str) -> dict[str, float]:
    """``["tau_max_s=5.2"]`` to ``{"tau_max_s": 5.2}``.

    Raises
    ------
    InputError
        If an entry is no NAME=VALUE, its value no number, or a name is given twice.
    """
    values: dict[str, float] = {}
    for entry in entries:
        name, equals, text = (part.strip() for part in entry.partition("="))
        if not equals or not name:
            raise InputError(f"{option}: found {entry!r}, expected NAME=VALUE")
        if name in values:
            raise InputError(f"{option}: found {name} twice, expected it once")
        try:
            values[name] = float(text)
        except ValueError:
            raise InputError(f"{option} {name}: found {text!r}, expected a number") from None
    return values
