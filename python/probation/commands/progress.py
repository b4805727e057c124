"""Progress of long work: a bar on a terminal, lines in a log."""

from __future__ import annotations

import sys
from contextlib import contextmanager
from typing import TYPE_CHECKING

from probation._text import printable, raw_stream
from probation.commands.streams import say

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator


@contextmanager
def shown(title: str, *, lines: bool = False) -> Iterator[Callable[[int, int, str], None]]:
    """Show a bar on standard error while the block runs; it vanishes at the end.

    Parameters
    ----------
    title : str
    lines : bool
        Whether to print a line at every tenth where standard error is no terminal; else nothing is printed there.

    Yields
    ------
    callable
        ``advance(done, total, what)``.
    """
    if not sys.stderr.isatty():
        yield _tenths(title) if lines else lambda done, total, what: None
        return
    from rich.console import Console  # noqa: PLC0415 - not every command shows progress
    from rich.progress import BarColumn, Progress, SpinnerColumn, TextColumn, TimeElapsedColumn  # noqa: PLC0415

    columns = (SpinnerColumn(), TextColumn("{task.description}", markup=False), BarColumn(), TimeElapsedColumn())
    with Progress(*columns, console=Console(file=raw_stream(sys.stderr)), transient=True) as progress:
        task = progress.add_task(printable(title), total=None)

        def advance(done: int, total: int, what: str) -> None:
            progress.update(
                task, completed=done, total=total, description=printable(f"{title}: {what}" if what else title)
            )

        yield advance


def _tenths(title: str) -> Callable[[int, int, str], None]:
    """Prints at every tenth."""

    def advance(done: int, total: int, what: str) -> None:
        if 10 * done // total > 10 * (done - 1) // total:
            say(f"{title}: {done} of {total}")

    return advance
