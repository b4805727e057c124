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

LONGEST_SILENCE = 60.0
"""Seconds after which there is a further line, at whatever part: a search for many effects may take minutes."""


@contextmanager
def shown(title: str) -> Iterator[Callable[[int, int, str], None]]:
    """Show on standard error how far the block is: on a terminal a bar that vanishes at the end, else lines.

    The bar comes after `SHOWN_AFTER` seconds. Where standard error is no terminal, there is a line at every tenth that
    is reached after `LOGGED_AFTER` seconds, and none of what goes on is silent for `LONGEST_SILENCE`.

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
    """Prints at every tenth, and after every `LONGEST_SILENCE`."""
    started, last_tenth, last = time.monotonic(), 0, 0.0

    def advance(done: int, total: int, what: str) -> None:
        nonlocal last_tenth, last
        tenths = 10 * done // total if total else 0
        elapsed = time.monotonic() - started
        silent_for_long = done > 0 and elapsed - last >= LONGEST_SILENCE
        if elapsed >= LOGGED_AFTER and (tenths > last_tenth or silent_for_long):
            last_tenth, last = tenths, elapsed
            say(f"{title}: {said(done / total, elapsed)}{f', {what}' if what else ''}")

    return advance
