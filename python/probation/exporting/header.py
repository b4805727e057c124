"""What stands at the head of an exported file."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

from probation._core import __version__
from probation._text import printable

if TYPE_CHECKING:
    from collections.abc import Sequence

_WIDTH = 78

_PLAIN = str.maketrans(
    {"τ": "tau", "α": "alpha", "σ": "sigma", "ε": "e", "·": "*", "±": "+-", "–": "-", "—": "-", "…": "...", "’": "'"}
)


def header_lines(what: str, parts: Sequence[Sequence[str]]) -> list[str]:
    """Paragraphs under a title, as printable text of at most 78 columns in plain ASCII."""
    lines = textwrap.wrap(f"probation {__version__}: {what}", _WIDTH - 6, subsequent_indent="  ")
    for part in parts:
        for line in part:
            lines += textwrap.wrap(printable(line), _WIDTH - 6, subsequent_indent="  ", break_long_words=True)
        lines.append("")
    return [line.translate(_PLAIN).encode("ascii", "replace").decode() for line in lines[:-1]]


def commented(lines: Sequence[str], prefix: str) -> str:
    """Each line behind the comment sign of a code."""
    return "".join(f"{prefix} {line}".rstrip() + "\n" for line in lines)


def c_comment(lines: Sequence[str]) -> str:
    """One comment of C."""
    harmless = [line.replace("*/", "* /").replace("/*", "/ *") for line in lines]
    return "/*\n" + "".join(f" * {line}".rstrip() + "\n" for line in harmless) + " */\n"
