"""Text that came from files, campaigns and the command line, made safe to show.

Names and paths are data: an escape sequence in one must not colour a terminal, move its cursor or hide a line, and a
bidirectional override must not turn the order of what is read. Two rules keep that from being forgotten:

- `Record.id` and `Campaign.name`, of which every result, page, figure and export takes its names, are made one
  printable line where the object is made. Nothing that is computed ever holds another name.
- Whatever else may hold text of a file (paths, headings, cells, messages) passes one of five outlets on its way to
  people, and each of them escapes: the standard streams (`printed_escaped`), a page (`report.page`), a figure
  (`report.figures`), the header of an export (`export.header`) and an answer in JSON (`answers`).

Error messages keep the text as it is, for programs that catch them; the command line prints them through an outlet.
"""

from __future__ import annotations

import sys
import unicodedata
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any, TextIO, cast

if TYPE_CHECKING:
    from collections.abc import Iterator


class _Escapes(dict[int, str | int]):
    """What each character is shown as; filled as characters are met."""

    def __missing__(self, code: int) -> str | int:
        character = chr(code)
        shown: str | int = code
        if not character.isprintable() and unicodedata.category(character) != "Zs":
            units = character.encode("utf-16-be", "surrogatepass").hex()
            shown = "".join(f"\\u{units[at : at + 4]}" for at in range(0, len(units), 4))
        self[code] = shown
        return shown


_LINE = _Escapes({ord("\n"): "\\n", ord("\r"): "\\r", ord("\t"): "\\t"})
_LINES = _Escapes({ord("\n"): "\n", ord("\t"): "\t"})


def printable(text: str) -> str:
    r"""One line in which what does not print (control, escape, bidirectional, unassigned) is escaped, as in JSON.

    >>> printable("ramp\x1b[31m\n\u202etset")
    'ramp\\u001b[31m\\n\\u202etset'
    """
    return text if text.isprintable() else text.translate(_LINE)


def printable_lines(text: str) -> str:
    """The same for text of several lines: line ends and tabs stay."""
    return text if text.isprintable() else text.translate(_LINES)


class PrintableStream:
    """A text stream that escapes what is written to it; all else is the stream's own.

    Attributes
    ----------
    raw : TextIO
        For the program's own control sequences.
    """

    def __init__(self, raw: TextIO) -> None:
        self.raw = raw

    def write(self, text: str) -> int:
        """Write the text, escaped."""
        return self.raw.write(printable_lines(text))

    def writelines(self, lines: list[str]) -> None:
        """Write the lines, escaped."""
        for line in lines:
            self.write(line)

    def __getattr__(self, name: str) -> Any:
        return getattr(self.raw, name)


def raw_stream(stream: TextIO) -> TextIO:
    """The stream below, for control sequences that the program itself writes around printable text."""
    return cast("TextIO", getattr(stream, "raw", stream)) if isinstance(stream, PrintableStream) else stream


@contextmanager
def printed_escaped() -> Iterator[None]:
    """Escape all that is printed on the standard streams within the block."""
    before = {name: getattr(sys, name) for name in ("stdout", "stderr")}
    for name, stream in before.items():
        if stream is not None:
            setattr(sys, name, PrintableStream(stream))
    try:
        yield
    finally:
        for name, stream in before.items():
            setattr(sys, name, stream)
