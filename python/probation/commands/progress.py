"""Progress of long work: a bar on a terminal, lines in a log."""

from __future__ import annotations

import sys
import time
from contextlib import contextmanager
from typing import TYPE_CHECKING

from probation.commands.streams import say
from probation.progress import SHOWN_AFTER, Part, TerminalBar, outermost, said

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LOGGED_AFTER = 10.0
"""Seconds that work lasts before a log gets a line."""


@contextmanager
def shown(title: str) -> Iterator[Callable[[int, int, str], None]]:
    """Show on standard error how far the block is: on a terminal a bar that vanishes at the end, else lines.

    The bar comes after `SHOWN_AFTER` seconds. Where standard error is no terminal, there is a line at every tenth that
    is reached after `LOGGED_AFTER` seconds.

    Yields
    ------
    callable
        ``advance(done, total, what)``.
    """
    with outermost():  # what is called within shows no bar of its own
        if not sys.stderr.isatty():
            yield _tenths(title)
            return
        bar = TerminalBar(title, SHOWN_AFTER)
        try:
            yield bar
        finally:
            bar.close()


def in_parts(advance: Callable[[int, int, str], None]) -> Callable[[float], None]:
    """The same for calls that tell a fraction from 0 to 1."""
    return lambda part: advance(round(100 * part), 100, part.doing if isinstance(part, Part) else "")


def _tenths(title: str) -> Callable[[int, int, str], None]:
    """Prints at every tenth."""
    started, last_tenth = time.monotonic(), 0

    def advance(done: int, total: int, what: str) -> None:
        nonlocal last_tenth
        tenths = 10 * done // total if total else 0
        elapsed = time.monotonic() - started
        if tenths > last_tenth and elapsed >= LOGGED_AFTER:
            last_tenth = tenths
            say(f"{title}: {said(done / total, elapsed)}{f', {what}' if what else ''}")

    return advance
