"""A bar in a notebook or a terminal for calls that last, without being asked for."""

from __future__ import annotations

import multiprocessing
import sys
import time
from contextlib import contextmanager
from functools import wraps
from html import escape
from importlib import import_module
from threading import Lock, Timer
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from probation._text import printable, raw_stream

if TYPE_CHECKING:
    from collections.abc import Callable, Iterator

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")

SHOWN_AFTER = 2.0
"""Seconds that work lasts before a bar is shown: what is done sooner needs none."""


class Part(float):
    """A fraction of the work, 0 to 1, and what is being done from there on."""

    doing: str

    def __new__(cls, part: float, doing: str = "") -> Part:
        """Make a fraction that says what is being done."""
        made = super().__new__(cls, part)
        made.doing = doing
        return made


_lock = Lock()
_running = 0


def in_notebook() -> bool:
    """Whether this Python is the kernel of a notebook."""
    shell = sys.modules["IPython"].get_ipython() if "IPython" in sys.modules else None
    return shell is not None and getattr(shell, "kernel", None) is not None


def on_terminal() -> bool:
    """Whether standard error is a terminal that a person may look at; a process that was started for one job is not."""
    return sys.stderr is not None and sys.stderr.isatty() and multiprocessing.parent_process() is None


@contextmanager
def outermost() -> Iterator[bool]:
    """Whether no other such block is open, in any thread: only then does a call within show a bar."""
    global _running  # noqa: PLW0603 - threads of the outermost call must see it, too
    with _lock:
        first = _running == 0
        _running += 1
    try:
        yield first
    finally:
        with _lock:
            _running -= 1


def shows_progress(function: Callable[Arguments, Answer]) -> Callable[Arguments, Answer]:
    """Let a function that takes `progress` show a bar in a notebook or a terminal where the caller gives none.

    A call within another one, or within a command that shows a bar, shows none of its own; nor does one that asks,
    because a bar in motion writes over the question.
    """

    @wraps(function)
    def shown(*arguments: Arguments.args, **options: Arguments.kwargs) -> Answer:
        with outermost() as first:
            silent = not first or options.get("progress") is not None or options.get("ask") is not None
            bar = None if silent else _bar(function.__name__.replace("_", " "))
            if bar is None:
                return function(*arguments, **options)
            try:
                options["progress"] = bar
                return function(*arguments, **options)
            finally:
                bar.close()

    return shown


def _bar(title: str) -> NotebookBar | TerminalBar | None:
    return NotebookBar(title) if in_notebook() else TerminalBar(title) if on_terminal() else None


class NotebookBar:
    """A bar that moves below a cell, from `after` seconds on, and goes when it is closed.

    Parameters
    ----------
    after : float [s]
    """

    def __init__(self, title: str, after: float = SHOWN_AFTER) -> None:
        self.title, self.after = title, after
        self.started = time.monotonic()
        self._shown: Any = None

    def __call__(self, done: float, total: float = 1.0, what: str = "") -> None:
        """Move: a fraction from 0 to 1, or done, total and what is being done."""
        elapsed = time.monotonic() - self.started
        if elapsed < self.after:
            return
        what = what or (done.doing if isinstance(done, Part) else "")
        html = self._html(min(max(done / total, 0.0), 1.0) if total else 0.0, elapsed, what)
        display = import_module("IPython.display")
        if self._shown is None:
            self._shown = display.display(display.HTML(html), display_id=True)
        else:
            self._shown.update(display.HTML(html))

    def close(self) -> None:
        """Take the bar away."""
        if self._shown is not None:
            self._shown.update(import_module("IPython.display").HTML(""))

    def _html(self, part: float, elapsed: float, what: str) -> str:
        label = escape(printable(f"{self.title}: {what}" if what else self.title))
        return (
            f'<div style="font:13px system-ui,sans-serif"><progress max="100" value="{100.0 * part:.0f}"></progress> '
            f"{label}, {said(part, elapsed)}</div>"
        )


class TerminalBar:
    """A bar that moves on standard error, from `after` seconds on, and goes when it is closed.

    Parameters
    ----------
    after : float [s]
    """

    def __init__(self, title: str, after: float = SHOWN_AFTER) -> None:
        self.title = title
        self._done, self._total, self._text = 0.0, 0.0, printable(title)
        self._shown: Any = None
        self._late = Timer(after, self._show)
        self._late.daemon = True
        self._late.start()

    def __call__(self, done: float, total: float = 1.0, what: str = "") -> None:
        """Move: a fraction from 0 to 1, or done, total and what is being done."""
        what = what or (done.doing if isinstance(done, Part) else "")
        self._done, self._total, self._text = done, total, printable(f"{self.title}: {what}" if what else self.title)
        self._move()

    def close(self) -> None:
        """Take the bar away."""
        self._late.cancel()
        self._late.join()
        if self._shown is not None:
            self._shown.stop()

    def _move(self) -> None:
        if self._shown is not None:
            task = self._shown.task_ids[0]
            self._shown.update(task, completed=self._done, total=self._total or None, description=self._text)

    def _show(self) -> None:
        """In another thread, and only of what lasts: quick calls do not load rich."""
        rich = import_module("rich.progress")
        columns = (
            rich.SpinnerColumn(),
            rich.TextColumn("{task.description}", markup=False),
            rich.BarColumn(),
            rich.TimeElapsedColumn(),
            rich.TextColumn("left"),
            rich.TimeRemainingColumn(compact=True),
        )
        console = import_module("rich.console").Console(file=raw_stream(sys.stderr))
        shown = rich.Progress(*columns, console=console, transient=True)
        shown.add_task(self._text, total=None)
        shown.start()
        self._shown = shown
        self._move()  # what was said before it was there


def said(part: float, elapsed: float) -> str:
    """How far, since when, and how long it may still take: "40 %, 0:31 so far, about 0:46 left"."""
    left = f", about {clock(elapsed * (1.0 - part) / part)} left" if 0.0 < part < 1.0 else ""
    return f"{100.0 * part:.0f} %, {clock(elapsed)} so far{left}"


def clock(seconds: float) -> str:
    """Minutes and seconds.

    >>> clock(31.2), clock(3725.0)
    ('0:31', '62:05')
    """
    return f"{int(seconds) // 60}:{int(seconds) % 60:02d}"
