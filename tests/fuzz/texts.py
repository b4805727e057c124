"""Tables to text, and what goes wrong with separators, quotes, line ends and encodings."""

from __future__ import annotations

from typing import TYPE_CHECKING

from fuzz import odd
from fuzz.bytes_damage import damaged
from fuzz.row_mutations import mutated

if TYPE_CHECKING:
    from collections.abc import Callable, Sequence
    from random import Random

    from fuzz.rows import Rows

_ENCODINGS = (
    "utf-8", "utf-8-sig", "utf-16", "utf-16-le", "utf-16-be", "utf-32", "cp1252", "gbk", "shift-jis", "utf-7",
    "cp037",
)  # fmt: skip
_NEWLINES = ("\n", "\r\n", "\r", "\n\r", "\n\n", "\x85", "\u2028", "\x0b", "\r\r\n")


def render(rows: Rows, separator: str | None = None) -> str:
    """Text of a table; cells that hold the separator, a quote or a line end stand in quotes."""
    between = rows.separator if separator is None else separator
    return "".join(between.join(_quoted(cell, between) for cell in row) + "\n" for row in rows.cells)


def encoded(text: str, encoding: str) -> bytes:
    """Bytes of a text; UTF-8 where the encoding has no such characters."""
    try:
        return text.encode(encoding)
    except UnicodeEncodeError:
        return text.encode("utf-8", "surrogatepass")


def hostile(makers: Sequence[Callable[[], Rows]], chance: Random, separator: str | None = None) -> tuple[bytes, Rows]:
    """The bytes of a table that went wrong in one to three places, and the table that it began as."""
    seed = rows = chance.choice(makers)()
    kinds = [chance.choice(("rows", "rows", "rows", "text", "bytes")) for _ in range(chance.choice((1, 1, 1, 2, 3)))]
    for _ in range(kinds.count("rows")):
        rows = mutated(rows, chance)
    text, encoding = render(rows, separator), rows.encoding
    for _ in range(kinds.count("text")):
        text, encoding = _changed(text, encoding, chance)
    data = encoded(text, encoding)
    for _ in range(kinds.count("bytes")):
        data = damaged(data, chance)
    return data, seed


def _changed(text: str, encoding: str, chance: Random) -> tuple[str, str]:
    """One thing that goes wrong with the text as a whole."""
    lines = text.split("\n")
    at = chance.randrange(len(lines))
    match chance.choice(("encoding", "newline", "separator", "separators", "quote", "insert", "line", "long", "mix")):
        case "encoding":
            return text, chance.choice(_ENCODINGS)
        case "newline":
            return text.replace("\n", chance.choice(_NEWLINES)), encoding
        case "separator":
            lines[at] = _other_separator(lines[at], chance)
        case "separators":
            lines = _other_separator(text, chance).split("\n")
        case "quote":
            place = chance.randrange(len(lines[at]) + 1)
            lines[at] = lines[at][:place] + chance.choice(('"', '""', "'", '"\n"')) + lines[at][place:]
        case "insert":
            place = chance.randrange(len(lines[at]) + 1)
            lines[at] = lines[at][:place] + chance.choice(odd.TEXTS) + lines[at][place:]
        case "line":
            lines.insert(at, chance.choice(odd.TEXTS))
        case "long":
            lines[at] += chance.choice((",", ";", "\t", " ", "0", "x", '"')) * chance.choice((1000, 140_000))
        case "mix":
            newline = chance.choice(_NEWLINES)
            return "".join(line + chance.choice(("\n", newline)) for line in lines), encoding
    return "\n".join(lines), encoding


def _other_separator(text: str, chance: Random) -> str:
    table = str.maketrans({old: chance.choice((",", ";", "\t", " ", "|", ":", "\x1f")) for old in ",;\t"})
    return text.translate(table)


def _quoted(cell: str, separator: str) -> str:
    if any(mark in cell for mark in (separator, '"', "\n", "\r")) or cell != cell.lstrip():
        return '"' + cell.replace('"', '""') + '"'
    return cell
