"""Help that fits the terminal: prose is filled, examples are broken where a shell goes on, long choices are listed."""

from __future__ import annotations

import argparse
import re
from textwrap import fill

_LONGEST_METAVAR = 36
_GAP = re.compile(r"( *)(\S.*?)( {2,})(\S.*)")
"""Of a line: its indentation, what stands left, the gap, what stands right."""


class HelpFormatter(argparse.RawDescriptionHelpFormatter):
    """Descriptions by `fitted`; an option of many choices shows its name in their place and lists them in its help."""

    def _fill_text(self, text: str, width: int, indent: str) -> str:
        return "\n".join(indent + line for line in fitted(text, width - len(indent)).split("\n"))

    def _get_help_string(self, action: argparse.Action) -> str | None:
        text = super()._get_help_string(action)
        return f"{text}; one of %(choices)s" if text and _many(action) else text

    def _get_default_metavar_for_optional(self, action: argparse.Action) -> str:
        return action.dest.upper()

    def _metavar_formatter(self, action: argparse.Action, default_metavar: str):  # type: ignore[no-untyped-def]
        if not _many(action):
            return super()._metavar_formatter(action, default_metavar)
        return lambda count: (default_metavar,) * count


def fitted(text: str, width: int) -> str:
    """A description with no line longer than the width, where words allow it.

    Parameters
    ----------
    text : str
        Lines that are not indented are prose, a line that ends a sentence or a clause ends its paragraph. Indented
        lines are examples, commands with or without a remark, or a word and what it means.

    Returns
    -------
    str
        Prose is filled; indented lines that fit stay as they are.
    """
    lines = text.rstrip("\n").split("\n")
    made: list[str] = []
    while lines:
        line = lines.pop(0)
        if not line.startswith(" "):
            while line and lines and lines[0] and not lines[0].startswith(" ") and line[-1] not in ".:;":
                line = f"{line} {lines.pop(0)}"
            made.append(_filled(line, width))
            continue
        gap = _GAP.fullmatch(line)
        if gap is not None and not gap[2].startswith("probation "):
            column = gap.start(4)
            while lines and len(lines[0]) - len(lines[0].lstrip()) == column:
                line = f"{line} {lines.pop(0).lstrip()}"
            made.append(_filled(line, width, column))
        elif len(line) <= width:
            made.append(line)
        elif gap is not None:
            made += [_command(gap[1] + gap[2], width), _filled(f"{gap[1]}    {gap[4]}", width, len(gap[1]) + 4)]
        else:
            made.append(_command(line, width))
    return "\n".join(made)


def _many(action: argparse.Action) -> bool:
    choices = action.choices or ()
    return (
        bool(action.option_strings) and action.metavar is None and len(",".join(map(str, choices))) > _LONGEST_METAVAR
    )


def _filled(line: str, width: int, column: int = 0) -> str:
    start = line[: len(line) - len(line.lstrip(" "))]
    if column and (gap := _GAP.fullmatch(line)) is not None:
        start = line[: gap.start(4)]
    words = line[len(start) :]
    return fill(
        words, width, initial_indent=start, subsequent_indent=" " * column, break_long_words=False,
        break_on_hyphens=False,
    )  # fmt: skip


def _command(line: str, width: int) -> str:
    """A command on several lines, broken before options."""
    if len(line) <= width:
        return line
    breaks = [found.start() for found in re.finditer(r" (?=--?[a-z])", line) if found.start() <= width - 2]
    if not breaks:
        return line
    indent = len(line) - len(line.lstrip(" "))
    rest = line[breaks[-1] + 1 :]
    deeper = indent if line[indent:].startswith("--") else indent + 4
    return f"{line[: breaks[-1]]} \\\n{_command(' ' * deeper + rest, width)}"
