"""Progress of long work: a bar on a terminal, lines in a log."""

from __future__ import annotations

import sys
import time
from contextlib import contextmanager
from threading import Timer
from typing import TYPE_CHECKING

from probation._text import printable, raw_stream
from probation.commands.streams import say
from probation.progress import SHOWN_AFTER, Part, said

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

LOGGED_AFTER = 10.0
"""Seconds that work lasts before a log gets a line."""


@contextmanager
def shown(title: str) -> Iterator[Callable[[int, int, str], None]]:
    """Show on standard error how far the block is: on a terminal a bar that vanishes at the end, else lines.

    The bar comes after `SHOWN_AFTER` seconds. Where standard error is no terminal, there is a line at every tenth that
    is reached after `LOGGED_AFTER` seconds.

    Parameters
    ----------
    title : str

    Yields
    ------
    callable
        ``advance(done, total, what)``.
    """
    if not sys.stderr.isatty():
        yield _tenths(title)
        return
    from rich.console import Console  # noqa: PLC0415 - not every command shows progress
    from rich.progress import (  # noqa: PLC0415
        BarColumn,
        Progress,
        SpinnerColumn,
        TextColumn,
        TimeElapsedColumn,
        TimeRemainingColumn,
    )

    columns = (
        SpinnerColumn(),
        TextColumn("{task.description}", markup=False),
        BarColumn(),
        TimeElapsedColumn(),
        TextColumn("left"),
        TimeRemainingColumn(compact=True),
    )
    progress = Progress(*columns, console=Console(file=raw_stream(sys.stderr)), transient=True)
    task = progress.add_task(printable(title), total=None)
    late = Timer(SHOWN_AFTER, progress.start)
    late.daemon = True
    late.start()

    def advance(done: int, total: int, what: str) -> None:
        progress.update(task, completed=done, total=total, description=printable(f"{title}: {what}" if what else title))

    try:
        yield advance
    finally:
        late.cancel()
        late.join()
        progress.stop()


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
