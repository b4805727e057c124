"""Bad input of a command, told in one line."""

from __future__ import annotations

from contextlib import contextmanager
from typing import TYPE_CHECKING

from probation.errors import InputError

if TYPE_CHECKING:
    from argparse import ArgumentParser
    from collections.abc import Iterator


@contextmanager
def one_line(parser: ArgumentParser) -> Iterator[None]:
    """End the command with the error's own words where what is done within finds bad input."""
    try:
        yield
    except InputError as error:
        parser.error(str(error))
