"""One wording for every complaint about a file: where, what was found, what was expected, what to do."""

from collections.abc import Iterable
from difflib import get_close_matches
from pathlib import Path

from probation.errors import InputError

_LONGEST_QUOTE = 40


def bad_input(
    path: Path | str,
    found: str,
    expected: str,
    *,
    row: int | None = None,
    column: str | None = None,
    remedy: str = "",
) -> InputError:
    """Build (not raise) the one-line error for a place in a file.

    Parameters
    ----------
    path : Path or str
        The file as the caller named it.
    found, expected : str
        What stands there, and what should.
    row : int, optional
        Row of the file, counted from 1 as an editor shows it.
    column : str, optional
        The column as the file heads it.
    remedy : str, optional
        What the user can do about it.
    """
    place = str(path)
    if row is not None:
        place += f", row {row}"
    if column is not None:
        place += f", column {quoted(column)}"
    message = f"{place}: found {found}, expected {expected}"
    return InputError(f"{message}; {remedy}" if remedy else message)


def quoted(text: str) -> str:
    """Quote text from a file so that it stays short and on one line."""
    return repr(text if len(text) <= _LONGEST_QUOTE else text[:_LONGEST_QUOTE] + "…")


def listed(names: Iterable[str], last: str = "or") -> str:
    """Join names for a sentence: 'a', 'b' or 'c'."""
    return joined(map(quoted, names), last)


def joined(texts: Iterable[str], last: str) -> str:
    """Join texts for a sentence as they are: s, N and mm."""
    shown = list(texts)
    return f" {last} ".join([", ".join(shown[:-1]), shown[-1]]) if len(shown) > 1 else "".join(shown)


def likely(name: str, known: Iterable[str]) -> str:
    """Ask whether the nearest known name was meant; empty when none is near."""
    by_folded_name = {candidate.casefold(): candidate for candidate in known}
    near = get_close_matches(name.casefold(), by_folded_name, n=1)
    return f"did you mean {quoted(by_folded_name[near[0]])}?" if near else ""


def suggestion(name: str, known: Iterable[str]) -> str:
    """Suggest the nearest known name, or list them all when none is near."""
    known = list(known)
    return likely(name, known) or f"use {listed(known)}"
