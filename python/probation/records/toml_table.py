"""A table of campaign.toml that checks what it is asked for and can name the row of what is wrong."""

import re
import tomllib
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import TypeVar, cast

from probation._complaint import bad_input, likely, listed, quoted, suggestion
from probation.errors import InputError
from probation.limits import LARGEST_PARAMETER, NESTING, NUMBER_DIGITS

_HEADER = re.compile(r"\s*\[{1,2}([^\[\]]+)\]{1,2}\s*(#.*)?")
_TOKEN = re.compile(
    "|".join(
        [
            r'"""(?:[^"\\]+|\\.|"(?!""))*+(?:""")?',  # strings and comments, which may hold anything
            r"'''(?:[^']+|'(?!''))*+(?:''')?",
            r'"(?:[^"\\\n]+|\\.)*+"?',
            r"'[^'\n]*+'?",
            r"#[^\n]*+",
            r"[\[{\]}.=\n]",
            rf"[0-9_]{{{NUMBER_DIGITS + 1},}}",
        ]
    ),
    re.DOTALL,
)
_LONGEST_VALUE = 60
"""Characters of a value that a complaint quotes."""
_NOT_TOO_LARGE = f"a magnitude of at most {LARGEST_PARAMETER:g}"
_T = TypeVar("_T")
_TYPES: dict[type, str] = {
    str: "text",
    dict: "a table",
    list: "a list",
    int: "a whole number",
    float: "a number",
}


@dataclass(frozen=True)
class TomlTable:
    """A table and where it stands.

    Attributes
    ----------
    name : str
        For people: ``"[law.companion]"``, ``"[[record]] 2"``; empty for the top.
    dotted : str
        As headers spell it: ``"law.companion"``, ``"record"``; empty for the top.
    values : mapping of str to object
        As tomllib read them.
    lines : list of str
        The whole file, to find rows in.
    first, last : int
        The part of the lines that this table covers.
    """

    path: Path
    name: str
    dotted: str
    values: Mapping[str, object]
    lines: list[str]
    first: int
    last: int

    @classmethod
    def load(cls, path: Path, text: str) -> "TomlTable":
        """Parse a TOML file.

        Raises
        ------
        InputError
            If it is no TOML, with row and column, or is nested or has numbers beyond the limits.
        """
        _check_nesting(path, text)
        try:
            values = tomllib.loads(text)
        except ValueError as failure:  # TOMLDecodeError, or a whole number beyond Python's own limit
            reason = str(failure).replace("at line ", "at row ")
            raise InputError(f"{path}: found no valid TOML: {reason}; correct it there") from None
        _check_whole_numbers(path, values)
        lines = text.replace("\r\n", "\n").split("\n")
        return cls(path=path, name="", dotted="", values=values, lines=lines, first=0, last=len(lines))

    def only(self, known: Collection[str]) -> None:
        """Refuse keys that are not known, and suggest the nearest that is."""
        for key in self.values:
            if key not in known:
                raise self.complain(key, f"the unknown key {quoted(key)}", "a known one", suggestion(key, known))

    def text(self, key: str, default: str | None = None, known: Collection[str] | None = None) -> str:
        """Get some text, required unless there is a default; one of the known if given."""
        value = self._typed(key, str, default)
        if not value.strip():
            raise self.complain(key, f"an empty {key}", "some text")
        if known is not None and value not in known:
            raise self.complain(key, f"{key} = {quoted(value)}", listed(known), likely(value, known))
        return value

    def number(self, key: str, default: float | None = None) -> float:
        """Get a finite number, whole ones welcome."""
        value = self._typed(key, float, default)
        if not float("-inf") < value < float("inf"):
            raise self.complain(key, f"{key} = {value}", "a finite number")
        if abs(value) > LARGEST_PARAMETER:
            raise self.complain(key, f"{key} = {value}", _NOT_TOO_LARGE)
        return float(value)

    def whole_number(self, key: str, default: int | None = None) -> int:
        """Get a whole number."""
        return self._typed(key, int, default)

    def numbers(self, key: str) -> tuple[float, ...]:
        """Get a list of finite numbers."""
        return self._finite(key, self._typed(key, list, None))

    def _finite(self, key: str, values: list[object]) -> tuple[float, ...]:
        """Check the entries of a list."""
        for value in values:
            finite = isinstance(value, int | float) and float("-inf") < value < float("inf")
            if isinstance(value, bool) or not finite:
                raise self.complain(key, f"{_shown(value)} in {key}", "finite numbers only")
            if isinstance(value, int | float) and abs(value) > LARGEST_PARAMETER:
                raise self.complain(key, f"{_shown(value)} in {key}", _NOT_TOO_LARGE)
        return tuple(float(value) for value in values if isinstance(value, int | float))

    def rows_of_numbers(self, key: str) -> tuple[tuple[float, ...], ...]:
        """Get a list of lists of finite numbers."""
        values: list[object] = self._typed(key, list, None)
        rows = []
        for value in values:
            if not isinstance(value, list):
                raise self.complain(key, f"{_shown(value)} in {key}", "a list of lists of numbers")
            rows.append(self._finite(key, value))
        return tuple(rows)

    def table(self, key: str) -> "TomlTable":
        """Get a table of its own, or written in braces; empty where there is none."""
        values: dict[str, object] = self._typed(key, dict, {})
        dotted = self._below(key)
        name = f"{self.name}, {key}" if self.name.startswith("[[") else f"[{dotted}]"
        first = self._line_of(key)
        return TomlTable(self.path, name, dotted, values, self.lines, first, self._end_of(first, dotted))

    def tables(self, key: str) -> Iterator["TomlTable"]:
        """Iterate over the tables headed ``[[key]]``."""
        if isinstance(self.values.get(key), dict):
            raise self.complain(key, f"a single [{key}]", f"[[{key}]], in double brackets")
        values: list[object] = self._typed(key, list, [])
        headers = [at for at, line in enumerate(self.lines) if re.match(rf"\s*\[\[\s*{key}\s*\]\]", line)]
        ends = [*headers[1:], len(self.lines)]
        for number, value in enumerate(values):
            if not isinstance(value, dict):
                raise self.complain(key, f"{_shown(value)} in {key}", f"[[{key}]] tables")
            first, last = (headers[number], ends[number]) if number < len(headers) else (0, self.last)
            yield TomlTable(self.path, f"[[{key}]] {number + 1}", key, value, self.lines, first, last)

    def complain(self, key: str | None, found: str, expected: str, remedy: str = "") -> InputError:
        """Error for a key of this table (or the table itself), with its row."""
        row = self._line_of(key) + 1 if key is not None else self.first + 1
        place = f" in {self.name}" if self.name else ""
        return bad_input(self.path, found + place, expected, row=row, remedy=remedy)

    def _typed(self, key: str, kind: type[_T], default: _T | None) -> _T:
        """Get a value of the kind wanted; whole numbers pass for numbers, true and false do not."""
        if key not in self.values:
            if default is not None:
                return default
            raise self.complain(None, f"no {key}", f"{_TYPES[kind]}", f"add {key} = …")
        value = self.values[key]
        fits = isinstance(value, (int, float) if kind is float else kind)
        if isinstance(value, bool) or not fits:
            raise self.complain(key, f"{key} = {_shown(value)}", _TYPES[kind])
        return cast(_T, value)

    def _below(self, key: str) -> str:
        return f"{self.dotted}.{key}" if self.dotted else key

    def _line_of(self, key: str) -> int:
        """Index of the line where a key of this table stands, or of the table's first line."""
        assigned = re.compile(rf"""(?<![\w.\-"'])["']?{re.escape(key)}["']?\s*[=.]""")
        for at in range(self.first, self.last):
            header = _HEADER.fullmatch(self.lines[at])
            if header and _is_within(header[1], self._below(key)):
                return at
            if not header and assigned.search(self.lines[at].split("#")[0]):
                return at
        return self.first

    def _end_of(self, first: int, dotted: str) -> int:
        """Index past the last line of a table that begins at this line."""
        for at in range(first + 1, self.last):
            header = _HEADER.fullmatch(self.lines[at])
            if header and not _is_within(header[1], dotted):
                return at
        return self.last


def _check_nesting(path: Path, text: str) -> None:
    """Refuse TOML nested beyond the limit, or with endless numbers, before a parser goes down into it."""
    depth = dots = 0
    for token in _TOKEN.finditer(text):
        first = token[0][0]
        depth += (first in "[{") - (first in "]}")
        dots = dots + 1 if first == "." else 0 if first in "=\n[{" else dots
        excess = (
            f"tables and lists nested deeper than {NESTING}"
            if max(depth, dots) >= NESTING
            else f"a number of more than {NUMBER_DIGITS} digits"
            if first in "0123456789_"
            else ""
        )
        if excess:
            raise bad_input(path, excess, "fewer", row=text.count("\n", 0, token.start()) + 1)


def _check_whole_numbers(path: Path, value: object, name: str = "") -> None:
    """Refuse whole numbers beyond the range that TOML gives them."""
    if isinstance(value, dict):
        for key, entry in value.items():
            _check_whole_numbers(path, entry, f"{name}.{key}" if name else key)
    elif isinstance(value, list):
        for entry in value:
            _check_whole_numbers(path, entry, name)
    elif isinstance(value, int) and not -(2**63) <= value < 2**63:
        raise bad_input(path, f"a whole number beyond 64 bits in {quoted(name)}", "a smaller one, or a decimal number")


def _shown(value: object) -> str:
    """A value as it may stand in a line: text quoted, lists and tables cut."""
    if isinstance(value, str):
        return quoted(value)
    text = repr(value)
    return text if len(text) <= _LONGEST_VALUE else f"{text[:_LONGEST_VALUE]}…"


def _is_within(header: str, dotted: str) -> bool:
    """Tell whether a header is that table's or one below it."""
    header = re.sub(r"""["'\s]""", "", header)
    return header == dotted or header.startswith(f"{dotted}.")
