"""Standard output and standard error, whatever became of them: closed, full, a pipe whose reader went away.

What goes to standard output was asked for: where it cannot be written, an error says so. What goes to standard error
(warnings, progress, which files were written) is reported where it can be; where it cannot, the work goes on.
"""

from __future__ import annotations

import os
import sys
from typing import TextIO

from probation._text import raw_stream

_STREAMS = (("stdin", "r"), ("stdout", "w"), ("stderr", "w"))

_closed: set[str] = set()


def open_closed() -> None:
    """Let closed streams lead into nothing, and their descriptors with them.

    A file that is opened next would get the descriptor of a closed stream, and every message would go into that file.
    """
    for name, mode in _STREAMS:
        if getattr(sys, name) is None:
            nowhere = os.open(os.devnull, os.O_RDWR)  # gets the lowest free descriptor: that of the closed stream
            os.set_inheritable(nowhere, True)
            setattr(sys, name, open(nowhere, mode, encoding="utf-8"))  # noqa: PTH123, SIM115 - a descriptor
            _closed.add(name)


def put(text: str = "", *, bold: str = "") -> None:
    """Write to standard output, and what is still buffered, now; what is `bold` first, and so on a terminal.

    Raises
    ------
    BrokenPipeError
        If its reader went away.
    OSError
        If it cannot be written: a full disk.
    """
    try:
        _write(sys.stdout, bold, text)
    except BrokenPipeError:
        silence(sys.stdout)
        raise
    except OSError as failure:
        silence(sys.stdout)
        raise OSError(failure.errno, failure.strerror, "standard output") from None


def put_data(text: str) -> None:
    """Write data to standard output, which must not be closed then.

    Raises
    ------
    OSError
        As `put` does, and where standard output is closed.
    """
    if "stdout" in _closed:
        raise OSError(None, "found it closed, expected it open for what was asked for there", "standard output")
    put(text)


def say(text: str, *, bold: str = "") -> None:
    """Write a line to standard error, what is `bold` first; it is left out where that cannot be written."""
    try:
        _write(sys.stderr, bold, text + "\n")
    except OSError:
        silence(sys.stderr)


def _write(stream: TextIO, bold: str, text: str) -> None:
    emphasised = bool(bold) and stream.isatty() and "NO_COLOR" not in os.environ
    if emphasised:
        raw_stream(stream).write("\x1b[1m")
    if bold:
        stream.write(bold)
    if emphasised:
        raw_stream(stream).write("\x1b[0m")
    if text:
        stream.write(text)
    stream.flush()


def silence(stream: TextIO) -> None:
    """Let what is still buffered go into nothing: the interpreter would fail once more when it ends."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())
    except (OSError, ValueError):  # not a real file, as under a test
        return
