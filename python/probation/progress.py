"""A bar in a notebook for calls that last, without being asked for."""

from __future__ import annotations

import sys
import time
from functools import wraps
from html import escape
from importlib import import_module
from threading import Lock
from typing import TYPE_CHECKING, Any, ParamSpec, TypeVar

from probation._text import printable

if TYPE_CHECKING:
    from collections.abc import Callable

Arguments = ParamSpec("Arguments")
Answer = TypeVar("Answer")

SHOWN_AFTER = 2.0
"""Seconds that work lasts before a bar is shown: what is done sooner needs none."""


class Part(float):
    """A fraction of the work, 0 to 1, and what is being done from there on.

    Attributes
    ----------
    doing : str
    """

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


def shows_progress(function: Callable[Arguments, Answer]) -> Callable[Arguments, Answer]:
    """Let a function that takes `progress` show a bar in a notebook where the caller gives none.

    A call within another one shows none of its own.
    """

    @wraps(function)
    def shown(*arguments: Arguments.args, **options: Arguments.kwargs) -> Answer:
        global _running  # noqa: PLW0603 - threads of the outermost call must see it, too
        with _lock:
            outermost = _running == 0
            _running += 1
        bar = None
        try:
            if outermost and options.get("progress") is None and in_notebook():
                bar = NotebookBar(function.__name__.replace("_", " "))
                options["progress"] = bar
            return function(*arguments, **options)
        finally:
            with _lock:
                _running -= 1
            if bar is not None:
                bar.close()

    return shown


class NotebookBar:
    """A bar that moves below a cell, from `after` seconds on, and goes when it is closed.

    Parameters
    ----------
    title : str
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
