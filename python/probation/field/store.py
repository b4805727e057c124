"""The maps on disk: a zarr store written block by block, each block a chunk of its own and marked when it is whole."""

from __future__ import annotations

import json
import os
import shutil
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, cast

import numpy as np

from probation._files import refusal
from probation.errors import InputError
from probation.field.extra import load
from probation.field.status import MEANINGS, Status

if TYPE_CHECKING:
    from collections.abc import Mapping

    import zarr
    from numpy.typing import NDArray

    from probation.field.grid import Block, BlockGrid
    from probation.law.modal import Law

SCHEMA = "probation.field/1"
LEDGER, SECONDS = "block_crc32", "block_cpu_seconds"
_MARK = 1 << 32
"""Added to a checksum in the ledger: an entry is never 0, which stands for a block that is not done."""


@dataclass(frozen=True)
class MapKind:
    """One map.

    Attributes
    ----------
    dtype : str
    fill : float
        Before it is written.
    unit, meaning : str
    """

    dtype: str
    fill: float
    unit: str
    meaning: str


def map_kinds(law: Law) -> dict[str, MapKind]:
    """The maps that an identification writes, by name."""
    time_name, time_unit = law.parameter_names[1], "s" if law.companion is None else "1"
    product = product_name(law)
    values = {
        "unrelaxed_modulus": ("MPa", "E_u"),
        time_name: (time_unit, "longest relaxation time" if law.companion is None else "tau_max over the companion's"),
        "hardening_modulus": ("MPa", "G"),
        product: ("MPa s" if law.companion is None else "MPa", f"E_u {time_name}, better known than its factors"),
    }
    kinds = {}
    for name, (unit, meaning) in values.items():
        kinds[name] = MapKind("<f8", np.nan, unit, meaning)
        kinds[f"{name}_standard_error"] = MapKind("<f8", np.nan, unit, f"standard error of {name}")
    return {
        **kinds,
        "rms_residual": MapKind("<f8", np.nan, "MPa", "model - measured, root mean square"),
        "noise": MapKind("<f8", np.nan, "MPa", "rms_residual that the noise of strain and stress alone would leave"),
        "samples": MapKind("<i4", 0, "1", "instants that the identification used"),
        "status": MapKind("|i1", Status.PENDING, "1", "; ".join(f"{int(k)}: {text}" for k, text in MEANINGS.items())),
    }


def product_name(law: Law) -> str:
    """Of the map of E_u tau_max, or E_u alpha."""
    return f"unrelaxed_modulus_times_{law.parameter_names[1]}"


@dataclass(frozen=True)
class MapStore:
    """Where the maps are, and how they are cut; small enough to be sent to any worker."""

    path: str
    grid: BlockGrid

    def create(self, kinds: Mapping[str, MapKind], run: Mapping[str, object], coordinates: Mapping[str, Any]) -> None:
        """An empty store, there whole or not at all.

        Parameters
        ----------
        kinds : dict of str to MapKind
        run : mapping
            What it is made from and by; must be the same for a run to go on.
        coordinates : mapping
            Positions along y and x, and their attributes.
        """
        part = f"{self.path}.{os.getpid()}.part"
        try:
            Path(part).parent.mkdir(parents=True, exist_ok=True)
            group = load("zarr").open_group(part, mode="w", attributes={"schema": SCHEMA, "run": dict(run)})
            for name, (values, attributes) in coordinates.items():
                axis = group.create_array(name, shape=values.shape, dtype="<f8", dimension_names=(name,))
                axis[...] = values
                axis.attrs.update(attributes)
            for name, kind in kinds.items():
                group.create_array(
                    name,
                    shape=self.grid.shape,
                    chunks=self.grid.block,
                    dtype=kind.dtype,
                    fill_value=kind.fill,
                    dimension_names=("y", "x"),
                    attributes={"units": kind.unit, "long_name": kind.meaning},
                )
            for name, dtype in ((LEDGER, "<u8"), (SECONDS, "<f8")):
                group.create_array(
                    name,
                    shape=self.grid.count,
                    chunks=(1, 1),
                    dtype=dtype,
                    fill_value=0,
                    dimension_names=("block_y", "block_x"),
                )
            Path(part).rename(self.path)
        except OSError as failure:
            shutil.rmtree(part, ignore_errors=True)
            raise refusal(self.path, failure) from None

    def write(self, block: Block, maps: Mapping[str, NDArray[Any]], cpu_seconds: float) -> None:
        """One block of all maps, then its mark: killed in between, the block counts as not done.

        Every array has chunks that belong to this block alone, and each is replaced whole: written twice, or by two
        workers at once, it is the same.
        """
        group = self._group("r+")
        at = self.grid.slices(block)
        for name, values in maps.items():
            _array(group, name)[at] = values
        _array(group, SECONDS)[block] = cpu_seconds
        _array(group, LEDGER)[block] = _MARK + _checksum(maps)

    def done(self, block: Block, names: Mapping[str, object]) -> bool:
        """Whether a block is marked, and what is there is what was written."""
        group = self._group("r")
        mark = int(np.asarray(_array(group, LEDGER)[block]))
        if mark == 0:
            return False
        at = self.grid.slices(block)
        return mark == _MARK + _checksum({name: np.asarray(_array(group, name)[at]) for name in names})

    def marked(self) -> NDArray[np.bool_]:
        """Which blocks are marked, without looking at what is there; of the grid's count."""
        return np.asarray(np.asarray(_array(self._group("r"), LEDGER)[...]) != 0)

    def _group(self, mode: str) -> zarr.Group:
        try:
            group: zarr.Group = load("zarr").open_group(self.path, mode=mode)
        except (OSError, ValueError) as failure:
            raise InputError(
                f"{self.path}: found no store of maps that can be opened ({failure}); does every worker see the folder?"
            ) from None
        return group


def read_run(path: str) -> dict[str, Any]:
    """What a store of maps was made from and by.

    Raises
    ------
    InputError
        If it is no store of maps of ours.
    """
    try:
        attributes = json.loads((Path(path) / "zarr.json").read_text())["attributes"]
        found, run = attributes["schema"], attributes["run"]
    except (OSError, ValueError, KeyError, TypeError):
        found, run = "none", None
    if found != SCHEMA or not isinstance(run, dict):
        raise InputError(f"{path}: found the schema {found!r}, expected {SCHEMA!r}, as probation field identify writes")
    return run


def _array(group: zarr.Group, name: str) -> zarr.Array[Any]:
    return cast("zarr.Array[Any]", group[name])


def _checksum(maps: Mapping[str, NDArray[Any]]) -> int:
    checksum = 0
    for name in sorted(maps):
        checksum = zlib.crc32(np.ascontiguousarray(maps[name]).tobytes(), checksum)
    return checksum
