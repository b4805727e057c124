"""How the law is solved, and which of its parameters keep their values: options that several commands have."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING, Literal

from probation.answers import PARAMETER_KEYS
from probation.law.schemes import DIFFERENTIABLE, STARTS

if TYPE_CHECKING:
    from collections.abc import Sequence

    from probation.law.schemes import SchemeName


def add_scheme(
    parser: argparse._ActionsContainer, default: SchemeName = "be2", choices: Sequence[SchemeName] = DIFFERENTIABLE
) -> None:
    """Add ``--scheme``."""
    parser.add_argument("--scheme", choices=choices, default=default, help=f"time integration ({default})")


def add_substeps(parser: argparse._ActionsContainer) -> None:
    """Add ``--substeps``."""
    parser.add_argument(
        "--substeps",
        metavar="N",
        type=_substeps,
        default="auto",
        help="steps of the scheme from sample to sample; auto takes as many as make its own error negligible",
    )


def _substeps(text: str) -> int | Literal["auto"]:
    if text == "auto":
        return "auto"
    if not text.isdecimal() or int(text) < 1:
        raise argparse.ArgumentTypeError(f"found {text!r}, expected 'auto' or a whole number of at least 1")
    return int(text)


def add_start(parser: argparse._ActionsContainer) -> None:
    """Add ``--start``."""
    parser.add_argument(
        "--start",
        choices=STARTS,
        default="exponential",
        help="be2's first step; the paper's is backward_euler",
    )


def add_hold(parser: argparse._ActionsContainer, remark: str = "") -> None:
    """Add ``--hold``; `named_numbers` reads it."""
    parser.add_argument(
        "--hold",
        metavar="NAME=VALUE",
        action="append",
        default=[],
        help=f"hold a parameter instead of identifying it: {', '.join(PARAMETER_KEYS.values())}{remark}; repeatable",
    )
