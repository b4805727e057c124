"""Packages that only some answers need: loaded when asked for, with one line where they are not installed."""

from __future__ import annotations

from importlib import import_module
from typing import Any

from probation.errors import InputError


def needed(package: str, what: str) -> Any:
    """The package, imported.

    Parameters
    ----------
    package : {"pandas", "xarray", "arviz", "emcee"}
    what : str
        What needs it, for the message.

    Raises
    ------
    InputError
        Where it is not installed.
    """
    try:
        return import_module(package)
    except ImportError:
        raise InputError(
            f"{what}: found no package {package}, expected it; pip install probation[notebook], or {package} alone"
        ) from None
