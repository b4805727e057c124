"""How the law is solved, and which of its parameters keep their values: options that several commands have."""

from __future__ import annotations

from typing import TYPE_CHECKING

from probation.answers import PARAMETER_KEYS
from probation.law.modal import DIFFERENTIABLE

if TYPE_CHECKING:
    import argparse
    from collections.abc import Sequence

    from probation.law.modal import Scheme


def add_scheme(
    parser: argparse._ActionsContainer, default: Scheme = "be2", choices: Sequence[Scheme] = DIFFERENTIABLE
) -> None:
    """Add ``--scheme``."""
    parser.add_argument("--scheme", choices=choices, default=default, help=f"time integration ({default})")


def add_start(parser: argparse._ActionsContainer) -> None:
    """Add ``--start``."""
    parser.add_argument(
        "--start",
        choices=("exponential", "backward_euler"),
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
