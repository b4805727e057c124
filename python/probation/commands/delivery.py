"""Where an answer goes: the files that were asked for, then the terminal."""

from __future__ import annotations

import argparse
import re
from contextlib import nullcontext
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from probation._files import check_file_place, check_folder_place, write_whole
from probation.commands.progress import shown
from probation.commands.streams import put, put_data, say
from probation.errors import InputError
from probation.wording import WIDTH, within_width

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence

    from matplotlib.figure import Figure

PLOT_ENDINGS = (".png", ".svg", ".pdf")
STANDARD_OUTPUT = "-"

_DECIMAL_COMMA = re.compile(r"^(0|-?\d+),(\d{1,2}|(?<=0,)\d+)$")
"""40,5 and 0,125; not 1,234, which may be a thousand and more."""


class Drawable(Protocol):
    """What can be drawn."""

    def plot(self) -> Figure:
        """The result as a figure."""


class Answer(Drawable, Protocol):
    """What every result can do."""

    def to_json(self) -> str:
        """The result as JSON text."""


class Reportable(Answer, Protocol):
    """What a result with a page can do, too."""

    def report(self, path: str) -> object:
        """Write the page."""


@dataclass(frozen=True)
class Output:
    """Something that was asked for, by an option or without one.

    Attributes
    ----------
    what : str
        Its name in messages: "JSON".
    path : str or None
        Where it goes; "-" is standard output, None nowhere.
    write : callable
        Writes it to a path; may return what to tell instead of `what` and the path.
    text : callable, optional
        Makes what goes to standard output.
    """

    what: str
    path: str | None
    write: Callable[[str], str | None]
    text: Callable[[], str] | None = None


def text_output(what: str, path: str | None, text: Callable[[], str]) -> Output:
    """A text, to a file or to standard output."""
    return Output(what, path, lambda place: write_whole(place, text()), text)


def plot_output(answer: Drawable, path: str | None) -> Output:
    """The plot of a result."""

    def write(place: str) -> None:
        from probation.report.figures import save_figure  # noqa: PLC0415 - matplotlib is slow to load

        save_figure(answer.plot(), place)

    return Output("plot", path, write)


def report_output(answer: Reportable, path: str | None) -> Output:
    """The page of a result."""

    def write(place: str) -> None:
        answer.report(place)

    return Output("report", path, write)


def usual_outputs(answer: Answer, options: argparse.Namespace) -> list[Output]:
    """Those of `add_delivery` without a page."""
    return [text_output("JSON", options.json, answer.to_json), plot_output(answer, options.plot)]


def outputs_with_report(answer: Reportable, options: argparse.Namespace) -> list[Output]:
    """Those of `add_delivery`."""
    return [*usual_outputs(answer, options), report_output(answer, options.report)]


def deliver(summary: str, outputs: Sequence[Output]) -> None:
    """Write every file, then print; what goes to standard output is alone there, the summary beside it.

    Nothing is printed before the files are written, because printing ends a command whose reader went away. One file
    that cannot be written costs neither the others nor the summary.

    Raises
    ------
    Exception
        The first failure, after all else is delivered; further ones are reported as warnings.
    """
    written: list[str] = []
    texts: list[str] = []
    failures: list[Exception] = []
    asked = [(output, output.path) for output in outputs if output.path is not None]
    with shown("writing") if asked else nullcontext():
        for output, path in asked:
            try:
                if path == STANDARD_OUTPUT and output.text is not None:
                    texts.append(output.text())
                else:
                    written.append(output.write(path) or f"{output.what} {path}")
            except Exception as failure:  # whatever it is, the others are written
                failures.append(failure)
    try:
        tell(summary, aside=any(path == STANDARD_OUTPUT for _, path in asked))
        for text in texts:
            put_data(text)
    finally:
        for each in written:
            say(f"wrote {each}")
        for further in failures[1:]:
            warn(described(further))
        if failures:
            raise failures[0]


def add_delivery(parser: argparse.ArgumentParser, *, report: bool = True) -> None:
    """Add ``--json``, ``--plot`` and ``--report``."""
    group = parser.add_argument_group("output")
    add_json(group)
    if report:
        group.add_argument("--report", metavar="FILE.html", type=output_file, help="write one self-contained HTML page")
    group.add_argument("--plot", metavar="FILE", type=plot_file, help="save the plot, as .png, .svg or .pdf")


def add_json(parser: argparse._ActionsContainer, what: str = "the answer") -> None:
    """Add ``--json``."""
    parser.add_argument(
        "--json",
        metavar="FILE",
        type=output_file_or_stream,
        help=f"write {what} as JSON; - is standard output, and alone there",
    )


def tell(summary: str, *, aside: bool = False) -> None:
    """Print a summary, the verdict that it begins with in bold on a terminal; `aside` on standard error."""
    if not summary:
        return
    lines = within_width(summary).split("\n")
    ends = 1
    while ends < len(lines) and lines[ends][:1].strip() and len(f"{lines[ends - 1]} {lines[ends].split()[0]}") > WIDTH:
        ends += 1  # a line that was broken there goes on
    verdict, rest = "\n".join(lines[:ends]), "\n".join(lines[ends:])
    newline = "\n" if ends < len(lines) else ""
    if aside:
        say(newline + rest, bold=verdict)
    else:
        put(newline + rest + "\n", bold=verdict)


def described(error: Exception) -> str:
    """An error in words; the system's own with what it is about first."""
    if not isinstance(error, OSError):
        return str(error)
    return ": ".join(str(part) for part in (error.filename, error.strerror or error) if part is not None)


def said(what: str, path: str | Path) -> None:
    """Tell, on standard error, that something was written."""
    say(f"wrote {what} {path}")


def warn(text: str) -> None:
    """Tell a warning on standard error."""
    say(f"warning: {text}")


def output_file(text: str) -> str:
    """Check, before anything is computed, that a file can be written there: the type of an option."""
    return _checked(text, check_file_place)


def output_file_or_stream(text: str) -> str:
    """As `output_file`, or "-"."""
    return text if text == STANDARD_OUTPUT else output_file(text)


def output_folder(text: str) -> str:
    """Check, before anything is computed, that the folder is there or can be made: the type of an option."""
    return _checked(text, check_folder_place)


def plot_file(text: str) -> str:
    """As `output_file`, of an ending that a plot can have."""
    if Path(text).suffix.lower() not in PLOT_ENDINGS:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a file that ends in {', '.join(PLOT_ENDINGS)}")
    return output_file(text)


OUTPUT_TYPES = (output_file, output_file_or_stream, output_folder, plot_file)
"""The type of every option that writes is one of these; a test tries each such option of every command."""


def _checked(text: str, check: Callable[[str], None]) -> str:
    try:
        check(text)
    except InputError as refusal:  # a ValueError, of which argparse would not show the text
        raise argparse.ArgumentTypeError(str(refusal)) from None
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
            values[name] = float(_DECIMAL_COMMA.sub(r"\1.\2", text))
        except ValueError:
            raise InputError(f"{option} {name}: found {text!r}, expected a number") from None
    return values
