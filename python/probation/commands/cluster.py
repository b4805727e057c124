"""``--processes`` and ``--scheduler``: processes of one's own, or the workers of a dask cluster."""

from __future__ import annotations

import importlib
from contextlib import contextmanager
from typing import TYPE_CHECKING

from probation.errors import InputError

if TYPE_CHECKING:
    import argparse
    from collections.abc import Iterator
    from concurrent.futures import Executor


def add_cluster(parser: argparse.ArgumentParser) -> None:
    """Add ``--processes`` and ``--scheduler``."""
    parser.add_argument("--processes", type=int, help="at a time (all processors)")
    parser.add_argument("--scheduler", metavar="ADDRESS", help="a dask scheduler, whose workers see the same folders")


@contextmanager
def cluster(address: str | None) -> Iterator[Executor | None]:
    """The executor of a dask cluster, if one is named.

    Raises
    ------
    InputError
        If distributed is not installed, or nobody answers at the address.
    """
    if address is None:
        yield None
        return
    try:
        distributed = importlib.import_module("distributed")
    except ImportError:
        raise InputError(
            "--scheduler: found no distributed; pip install 'probation[cluster]', or leave it out"
        ) from None
    try:
        client = distributed.Client(address)
    except (OSError, ValueError) as failure:
        raise InputError(f"--scheduler: found nobody at {address}: {failure}") from None
    with client, client.get_executor() as executor:
        yield executor
