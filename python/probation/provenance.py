"""Where an answer came from: version, data, seed, command."""

from __future__ import annotations

import hashlib
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from probation._core import __version__

if TYPE_CHECKING:
    from collections.abc import Iterator

    from probation._arrays import FloatArray

_command: ContextVar[str] = ContextVar("command", default="")


@dataclass(frozen=True)
class Provenance:
    """What the footer of a page says.

    Attributes
    ----------
    data_sha256 : str
        Empty where there is no data.
    seed : int or None
        Where there is chance in it.
    command : str
        The command line; empty when called from Python.
    """

    version: str
    data_sha256: str
    seed: int | None
    command: str


def provenance(data_sha256: str = "", seed: int | None = None) -> Provenance:
    """The provenance of an answer made now."""
    return Provenance(__version__, data_sha256, seed, _command.get())


@contextmanager
def running(command: str) -> Iterator[None]:
    """Say which command line answers are made by, within the block."""
    token = _command.set(command)
    try:
        yield
    finally:
        _command.reset(token)


def samples_sha256(*samples: FloatArray) -> str:
    """SHA-256 of arrays of samples, in hexadecimal."""
    digest = hashlib.sha256()
    for values in samples:
        digest.update(np.ascontiguousarray(values, dtype="<f8").tobytes())
    return digest.hexdigest()
