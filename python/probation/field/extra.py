"""What only fields need, loaded when it is: xarray and zarr."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING

from probation.errors import InputError

if TYPE_CHECKING:
    from types import ModuleType


def load(name: str) -> ModuleType:
    """The module by that name.

    Raises
    ------
    InputError
        If it is not installed, saying what to install.
    """
    try:
        return importlib.import_module(name)
    except ImportError:
        raise InputError(f"field: found no {name}, expected it installed: pip install 'probation[field]'") from None
