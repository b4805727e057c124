"""Which effects are considered, the seed of the noise, and how many threads work: options of several commands."""

from __future__ import annotations

import argparse
import math
from typing import TYPE_CHECKING

from probation.errors import InputError
from probation.processors import processors

if TYPE_CHECKING:
    from collections.abc import Callable

MOST_AT_ONCE = 4
"""Processes of one diagnosis: an eighth of its work is one after the other, and each copy takes time and memory."""


def add_effects(parser: argparse._ActionsContainer) -> None:
    """Add ``--effects``; `effects_from_options` reads it."""
    parser.add_argument(
        "--effects",
        metavar="NAME,NAME",
        action="append",
        type=_names,
        help="consider only these effects (all); names as probation diagnose --list-effects lists them",
    )


def add_seed(parser: argparse._ActionsContainer) -> None:
    """Add ``--seed``."""
    parser.add_argument("--seed", metavar="N", type=whole_number(0), default=0, help="of the simulated noise (0)")


def add_threads(parser: argparse._ActionsContainer) -> None:
    """Add ``--threads``."""
    parser.add_argument(
        "--threads",
        metavar="N",
        type=whole_number(1),
        default=min(processors(), MOST_AT_ONCE),
        help=f"at most so many processes at once, on Linux (one per processor, up to {MOST_AT_ONCE})",
    )


def effects_from_options(options: argparse.Namespace) -> list[str] | None:
    """Names of the effects to be considered; None: all."""
    return [name for group in options.effects or () for name in group] or None


def check_effects(names: list[str] | None) -> None:
    """Raise an `InputError` for an effect that is not known."""
    from probation.effects.registry import effects  # noqa: PLC0415 - see the package

    try:
        effects(names)
    except InputError as error:
        raise InputError(f"--effects: {error}") from None


def _names(text: str) -> list[str]:
    names = [name.strip() for name in text.split(",") if name.strip()]
    if not names:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected names such as self_heating,damage")
    return names


def seconds(text: str) -> float:
    """A positive time in seconds; for `type=`."""
    try:
        value = float(text)
    except ValueError:
        value = -1.0
    if not 0.0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a positive number of seconds")
    return value


def whole_number(least: int) -> Callable[[str], int]:
    """Reads a whole number of at least that; for `type=`."""

    def read(text: str) -> int:
        if not text.isdecimal() or int(text) < least:
            raise argparse.ArgumentTypeError(f"found {text!r}, expected a whole number from {least}")
        return int(text)

    return read


def fraction(text: str) -> float:
    """A number between 0 and 1, such as 0.05; for `type=`."""
    try:
        value = float(text)
    except ValueError:
        value = math.nan
    if not 0.0 < value < 1.0:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected a fraction between 0 and 1, such as 0.05")
    return value
