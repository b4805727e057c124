"""Laboratories by name."""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Protocol, cast

from probation.errors import InputError

if TYPE_CHECKING:
    from pathlib import Path

OWN = "own"
LABORATORIES = {
    OWN: "probation_studies.blind.laboratory",
    "wider": "probation_studies.blind.laboratory.wider",
    "university": "probation_studies.blind.laboratories.university",
    "industry": "probation_studies.blind.laboratories.industry",
    "institute": "probation_studies.blind.laboratories.institute",
    "test_house": "probation_studies.blind.laboratories.test_house",
}
"""The package of every laboratory; see `probation_studies.blind.laboratories`."""


class _Truth(Protocol):
    def to_json(self) -> str: ...


class _Made(Protocol):
    @property
    def truth(self) -> _Truth: ...

    def write(self, folder: str | Path) -> Path: ...


class Laboratory(Protocol):
    """What a laboratory's package offers."""

    SPLITS: tuple[str, ...]
    STRATA: tuple[str, ...]

    def make(self, seed: int, index: int, split: str = ..., stratum: str | None = ...) -> _Made:
        """One campaign and what is withheld of it; a stratum is drawn if left out."""


def laboratory_named(name: str) -> Laboratory:
    """The laboratory of that name.

    Raises
    ------
    InputError
        If there is none.
    """
    if name not in LABORATORIES:
        raise InputError(f"laboratory: found {name!r}, expected one of {', '.join(LABORATORIES)}")
    return cast("Laboratory", importlib.import_module(LABORATORIES[name]))
