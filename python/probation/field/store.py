"""The maps on disk: a zarr store written block by block, each block a chunk of its own and marked when it is whole."""

from __future__ import annotations

import json
import os
import shutil
import zlib
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation._files import refusal
from probation.errors import InputError
from probation.field.chunks import create, read, write
from probation.field.extra import load
from probation.field.status import MEANINGS, Status

if TYPE_CHECKING:
    from collections.abc import Iterable, Mapping

    from numpy.typing import NDArray

    from probation.field.grid import Block, BlockGrid

SCHEMA = "probation.field/1"
LEDGER, SECONDS, SUBSTEPS = "block_crc32", "block_cpu_seconds", "block_substeps"
_MARK = 1 << 32
"""Added to a checksum in the ledger: an entry is never 0, which stands for a block that is not done."""

_RUN: dict[str, Callable[[Any], bool]] = {
    **dict.fromkeys(("scheme", "method", "version", "field_sha256"), lambda value: isinstance(value, str)),
    "law": lambda value: isinstance(value, dict) and "companion" in value,
    "block": lambda value: (
        isinstance(value, list) and len(value) == 2 and all(type(count) is int and count > 0 for count in value)
    ),
}
"""What `read_run` needs to find, and whether it is of the right kind."""


@dataclass(frozen=True)
class MapKind:
    """One map.

    Attributes
    ----------
    fill : float
        Before it is written.
    """

    dtype: str
    fill: float
    unit: str
    meaning: str


def map_kinds(*, companion: bool) -> dict[str, MapKind]:
    """The maps that an identification writes, by name; with a companion relation, alpha stands for tau_max."""
    time_name = "alpha" if companion else "tau_max"
    values = {
        "unrelaxed_modulus": ("MPa", "E_u"),
        time_name: ("1", "tau_max over the companion's") if companion else ("s", "longest relaxation time"),
        "hardening_modulus": ("MPa", "G"),
        product_name(time_name): ("MPa" if companion else "MPa s", f"E_u {time_name}, better known than its factors"),
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


def product_name(time_name: str) -> str:
    """Of the map of E_u tau_max, or E_u alpha."""
    return f"unrelaxed_modulus_times_{time_name}"


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
                create(group, name, values.shape, (name,), attributes=attributes)[...] = values
            for name, kind in kinds.items():
                attributes = {"units": kind.unit, "long_name": kind.meaning}
                create(
                    group,
                    name,
                    self.grid.shape,
                    ("y", "x"),
                    chunks=self.grid.block,
                    dtype=kind.dtype,
                    fill=kind.fill,
                    attributes=attributes,
                )
            for name, dtype in ((LEDGER, "<u8"), (SECONDS, "<f8"), (SUBSTEPS, "<i4")):
                create(group, name, self.grid.count, ("block_y", "block_x"), chunks=(1, 1), dtype=dtype, fill=0)
            Path(part).rename(self.path)
        except OSError as failure:
            shutil.rmtree(part, ignore_errors=True)
            raise refusal(self.path, failure) from None

    def write(self, block: Block, maps: Mapping[str, NDArray[Any]], cpu_seconds: float, substeps: int) -> None:
        """One block of all maps, then its mark: killed in between, the block counts as not done.

        Every array has chunks that belong to this block alone, and each is replaced whole: written twice, or by two
        workers at once, it is the same.
        """
        self._require()
        at = self.grid.slices(block)
        try:
            for name, values in maps.items():
                write(self.path, name, at, values)
            write(self.path, SECONDS, block, cpu_seconds)
            write(self.path, SUBSTEPS, block, substeps)
            write(self.path, LEDGER, block, mark_of(maps))
        except OSError as failure:
            reason = failure.strerror or failure
            raise InputError(f"{self.path}: cannot be written: {reason}; what is done is kept") from None

    def done(self, block: Block, names: Iterable[str]) -> bool:
        """Whether a block is marked, and what is there is what was written; a damaged chunk is not."""
        self._require()
        try:
            mark = self._mark(block)
            return mark != 0 and mark == mark_of(
                {name: read(self.path, name, self.grid.slices(block)) for name in names}
            )
        except InputError:
            return False

    def marked(self) -> NDArray[np.bool_]:
        """Which blocks are marked, without looking at what is there, of the grid's count; a damaged mark is none."""
        self._require()
        try:
            return np.asarray(read(self.path, LEDGER, sparse=True) != 0)
        except InputError:
            marks: NDArray[np.bool_] = np.zeros(self.grid.count, dtype=bool)
            for block in self.grid.blocks():
                with suppress(InputError):
                    marks[block] = self._mark(block) != 0
            return marks

    def _mark(self, block: Block) -> int:
        at = tuple(slice(place, place + 1) for place in block)
        return int(read(self.path, LEDGER, at, sparse=True).item())

    def _require(self) -> None:
        if not (Path(self.path) / "zarr.json").is_file():
            raise InputError(f"{self.path}: found no store of maps; does every worker see the folder?")


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
    except (OSError, ValueError, KeyError, TypeError, RecursionError):
        found, run = "none", None
    if found != SCHEMA or not isinstance(run, dict):
        raise InputError(f"{path}: found the schema {found!r}, expected {SCHEMA!r}, as probation field identify writes")
    for key, right in _RUN.items():
        if not right(run.get(key)):
            found = repr(run.get(key))[:60]
            raise InputError(f"{path}: run: found {key} {found}, expected it as probation field identify writes")
    return run


def mark_of(maps: Mapping[str, NDArray[Any]]) -> int:
    """A block's entry in the ledger: the checksum of its maps."""
    checksum = 0
    for name in sorted(maps):
        checksum = zlib.crc32(np.ascontiguousarray(maps[name]).tobytes(), checksum)
    return _MARK + checksum
