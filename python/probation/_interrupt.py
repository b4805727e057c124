"""Ctrl-C while the command line is still loading: Python would show the stack of its imports.

Importing this module lets Ctrl-C end the process at once, where that process is the command.
"""

from __future__ import annotations

import os
import signal
import sys
from itertools import pairwise
from pathlib import Path
from types import FrameType

INTERRUPTED = 130
"""Exit status of a command that was interrupted."""


def loaded() -> None:
    """From now on Ctrl-C raises KeyboardInterrupt again, so that what was begun is put away."""
    if signal.getsignal(signal.SIGINT) is _end:
        sys.unraisablehook = _end_where_unraisable
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _end(number: int, frame: FrameType | None) -> None:
    os._exit(INTERRUPTED)


def _end_where_unraisable(unraisable: sys.UnraisableHookArgs) -> None:
    """End where Python cannot pass KeyboardInterrupt on, as in a callback of an import: it would show it and go on."""
    if issubclass(unraisable.exc_type, KeyboardInterrupt):
        os._exit(INTERRUPTED)
    sys.__unraisablehook__(unraisable)


def _is_command() -> bool:
    """Whether it is ``probation …`` or ``python -m probation …``."""
    if sys.argv[:1] == ["-m"]:  # as Python has it while it looks for the module
        return ("-m", "probation") in pairwise(sys.orig_argv)
    return Path(sys.argv[0]).stem == "probation" if sys.argv else False


if _is_command() and signal.getsignal(signal.SIGINT) is signal.default_int_handler:
    signal.signal(signal.SIGINT, _end)  # nothing is begun yet, nothing is lost
