"""`FieldMaps`: what was identified, pixel by pixel, read and reported."""

from __future__ import annotations

from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.errors import InputError
from probation.field.chunks import array_of, read, require_chunks
from probation.field.grid import BlockGrid
from probation.field.status import MEANINGS, Status
from probation.field.store import LEDGER, SECONDS, SUBSTEPS, map_kinds, mark_of, read_run
from probation.field.truth import Closeness, closeness
from probation.results.data import CURVE, Stored, WithCurves, from_curves
from probation.results.rendering import Result
from probation.settings.field import FIELD

if TYPE_CHECKING:
    import os
    from collections.abc import Callable, Mapping

    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.field.store import MapKind

AGAIN = "probation field identify, called again,"


@dataclass(frozen=True)
class FieldMaps(Result, Stored, WithCurves):
    """Maps of a field.

    Attributes
    ----------
    run : dict
        What they were made from and by.
    maps : dict of str to ndarray, shape (rows, columns)
        As they are named in the store.
    units : dict of str to str
    y, x : ndarray
        Positions, or pixels counted from 0.
    length_unit : str
        Of those; empty for pixels.
    cpu_seconds : float
        Of all blocks.
    substeps : (int, int)
        Fewest and most steps of the scheme from sample to sample that a block took.
    closeness : tuple of Closeness
        To the truth, where that is known; see `FieldMaps.compared_with`.
    """

    SCHEMA = "probation.field/1"

    path: str
    run: dict[str, Any]
    maps: dict[str, NDArray[Any]] = field(repr=False, metadata=CURVE)
    units: dict[str, str] = field(repr=False)
    y: FloatArray = field(repr=False, metadata=CURVE)
    x: FloatArray = field(repr=False, metadata=CURVE)
    length_unit: str
    cpu_seconds: float
    substeps: tuple[int, int]
    blocks: int
    blocks_done: int
    closeness: tuple[Closeness, ...] = ()

    @property
    def identified(self) -> NDArray[np.bool_]:
        """Where the law was identified."""
        return np.asarray(self.maps["status"] == Status.IDENTIFIED)

    @property
    def beyond_noise(self) -> NDArray[np.bool_]:
        """Where the residual is more than noise leaves."""
        samples = np.maximum(self.maps["samples"], 1)
        doubt = np.sqrt(FIELD.uneven / samples)
        with np.errstate(invalid="ignore"):
            return np.asarray(
                self.identified & (self.maps["rms_residual"] > np.exp(FIELD.certain * doubt) * self.maps["noise"])
            )

    @property
    def names(self) -> tuple[str, str, str, str]:
        """The product and the three parameters, as their maps are called."""
        second = "tau_max" if "tau_max" in self.units else "alpha"
        return f"unrelaxed_modulus_times_{second}", "unrelaxed_modulus", second, "hardening_modulus"

    def compared_with(self, truth: str | os.PathLike[str]) -> FieldMaps:
        """The same maps, compared with a store of what is true, as `probation field example` writes one.

        Raises
        ------
        InputError
            If there is no such store, or it lacks a map or is of another shape.
        """
        return replace(self, closeness=closeness(self.maps, self.names, self.identified, truth))

    @from_curves
    def counts(self) -> dict[int, int]:
        """Pixels of each status that there is."""
        statuses, numbers = np.unique(self.maps["status"], return_counts=True)
        return dict(zip(statuses.tolist(), numbers.tolist(), strict=True))

    @from_curves
    def facts(self) -> dict[str, Any]:
        """Counts and medians over the pixels that were identified; the maps themselves stay in the store."""
        good, beyond = self.identified, self.beyond_noise
        rows, columns = np.nonzero(beyond)
        return {
            "beyond_noise": len(rows),
            "where_beyond_noise": {
                "y": [float(self.y[rows.min()]), float(self.y[rows.max()])],
                "x": [float(self.x[columns.min()]), float(self.x[columns.max()])],
            }
            if len(rows)
            else None,
            "pixels_with_data": int(np.count_nonzero(self.maps["samples"] > 0)),
            "parameters": {
                name: {
                    "unit": self.units[name],
                    "median": _quantile(self.maps[name][good], 0.5),
                    "median_standard_error": _quantile(self.maps[f"{name}_standard_error"][good], 0.5),
                    "median_relative_standard_error": _quantile(
                        self.maps[f"{name}_standard_error"][good] / np.abs(self.maps[name][good]), 0.5
                    ),
                    "percentiles_5_95": [_quantile(self.maps[name][good], part) for part in (0.05, 0.95)],
                }
                for name in self.names
            },
            "rms_residual_MPa": _quantile(self.maps["rms_residual"][good], 0.5),
            "noise_MPa": _quantile(self.maps["noise"][good], 0.5),
        }

    def to_dict(self) -> dict[str, Any]:
        """The answer as Python objects."""
        return {
            "maps": self.path,
            "run": self.run,
            "pixels": {MEANINGS[Status(status)]: count for status, count in self.counts.items()},
            **self.facts,
            "blocks": {"done": self.blocks_done, "all": self.blocks},
            "cpu_seconds": self.cpu_seconds,
            "substeps": list(self.substeps),
            "closeness": [vars(parameter) for parameter in self.closeness],
        }


def open_maps(path: str | os.PathLike[str], progress: Callable[[int, int, str], None] | None = None) -> FieldMaps:
    """Read the maps that `identify_field` wrote, those of a run that is not finished, too.

    Parameters
    ----------
    path : str or path
    progress : callable, optional
        Called with the maps that are read, their number, and which is being read.

    Raises
    ------
    InputError
        If `path` is no store of maps, or an array or chunk of it is not there or not what was written, naming it.
    """
    where = str(Path(path).absolute())
    if not Path(where).exists():
        raise InputError(f"{path}: found no such folder, expected maps as probation field identify writes them")
    run = read_run(where)
    kinds = map_kinds(companion=run["law"]["companion"] is not None)
    shape = array_of(where, "status").shape
    if len(shape) != 2 or 0 in shape:
        raise InputError(f"{where}: status: found the shape {shape}, expected rows and columns")
    grid = BlockGrid((shape[0], shape[1]), (run["block"][0], run["block"][1]))
    marks = _numbers(where, LEDGER, grid.count, "u8", sparse=True)
    maps = _maps(where, kinds, grid, marks, progress or (lambda done, total, what: None))
    here = [name for name in ("y", "x") if (Path(where) / name).exists()]
    axes = {name: _numbers(where, name, (size,), "f8") for name, size in zip(("y", "x"), shape, strict=True) if here}
    done = marks != 0
    seconds = _numbers(where, SECONDS, grid.count, "f8", sparse=True)
    steps = _numbers(where, SUBSTEPS, grid.count, "i4", sparse=True)[done]
    return FieldMaps(
        where,
        run,
        maps,
        {name: kind.unit for name, kind in kinds.items()},
        axes["y"] if axes else np.arange(float(shape[0])),
        axes["x"] if axes else np.arange(float(shape[1])),
        str(array_of(where, "y").attrs.get("units", "")) if axes else "",
        float(seconds[done].sum()),
        (int(steps.min()), int(steps.max())) if len(steps) else (1, 1),
        done.size,
        int(np.count_nonzero(done)),
    )


def _maps(
    where: str,
    kinds: Mapping[str, MapKind],
    grid: BlockGrid,
    marks: NDArray[Any],
    advance: Callable[[int, int, str], None],
) -> dict[str, NDArray[Any]]:
    """All maps: each there, whole, and in every block that is done what was written."""
    marked = [block for block in grid.blocks() if marks[block]]
    try:
        maps: dict[str, NDArray[Any]] = {}
        for name, kind in kinds.items():
            advance(len(maps), len(kinds) + 1, name)
            for block in marked:
                require_chunks(where, name, grid.slices(block))
            maps[name] = _numbers(where, name, grid.shape, kind.dtype, sparse=True)
    except InputError as failure:
        raise InputError(f"{failure}; {AGAIN} does such blocks anew") from None
    advance(len(maps), len(kinds) + 1, "looking for damage")
    for block in marked:
        at = grid.slices(block)
        if marks[block] != mark_of({name: values[at] for name, values in maps.items()}):
            raise InputError(
                f"{where}: block {block}: found maps that are not what was written; {AGAIN} does that block anew"
            )
    unknown = set(np.unique(maps["status"]).tolist()) - set(Status)
    if unknown:
        raise InputError(
            f"{where}: status: found {min(unknown)}, expected one of {', '.join(map(str, map(int, Status)))}"
        )
    return maps


def _numbers(where: str, name: str, shape: tuple[int, ...], dtype: str, *, sparse: bool = False) -> NDArray[Any]:
    """An array, looked over."""
    array = array_of(where, name)
    if array.shape != shape or array.dtype != np.dtype(dtype):
        raise InputError(
            f"{where}: {name}: found {array.dtype} of the shape {array.shape}, expected {np.dtype(dtype)} of {shape}"
        )
    return read(where, name, sparse=sparse)


def _quantile(values: FloatArray, part: float) -> float:
    """Of the finite values; NaN where there are none."""
    finite = values[np.isfinite(values)]
    return float(np.quantile(finite, part)) if len(finite) else float("nan")
