"""`FieldMaps`: what was identified, pixel by pixel, read and told."""

from __future__ import annotations

from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from probation.answers import json_answer
from probation.errors import InputError
from probation.field.extra import load
from probation.field.status import MEANINGS, Status
from probation.field.store import LEDGER, SECONDS, read_run

if TYPE_CHECKING:
    import os

    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from probation._arrays import FloatArray
    from probation.field.truth import Closeness

CERTAIN, UNEVEN = 4.0, 2.0
"""Standard deviations of rms_residual / noise - 1 from which on a residual is beyond the noise, and their square times
the samples: 1/2 for even noise, more where it grows along the record."""


@dataclass(frozen=True)
class FieldMaps:
    """Maps of a field.

    Attributes
    ----------
    path : str
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
    blocks, blocks_done : int
    closeness : tuple of Closeness
        To the truth, where that is known; see `FieldMaps.beside`.
    """

    path: str
    run: dict[str, Any]
    maps: dict[str, NDArray[Any]] = field(repr=False)
    units: dict[str, str] = field(repr=False)
    y: FloatArray = field(repr=False)
    x: FloatArray = field(repr=False)
    length_unit: str
    cpu_seconds: float
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
        doubt = np.sqrt(UNEVEN / samples)
        with np.errstate(invalid="ignore"):
            return np.asarray(
                self.identified & (self.maps["rms_residual"] > (1.0 + CERTAIN * doubt) * self.maps["noise"])
            )

    @property
    def names(self) -> tuple[str, str, str, str]:
        """The product and the three parameters, as their maps are called."""
        second = "tau_max" if "tau_max" in self.maps else "alpha"
        return f"unrelaxed_modulus_times_{second}", "unrelaxed_modulus", second, "hardening_modulus"

    def beside(self, truth: str | os.PathLike[str]) -> FieldMaps:
        """The same maps, held against a store of what is true, as `probation field example` writes one.

        Raises
        ------
        InputError
            If there is no such store, or it lacks a map or is of another shape.
        """
        from dataclasses import replace  # noqa: PLC0415

        from probation.field.truth import closeness  # noqa: PLC0415

        return replace(self, closeness=closeness(self, truth))

    def summary(self) -> str:
        """The verdict, then numbers, as text."""
        from probation.field.words import summary  # noqa: PLC0415

        return summary(self)

    def plot(self) -> Figure:
        """The maps as a figure."""
        from probation.field.figure import figure  # noqa: PLC0415 - matplotlib is slow to load

        return figure(self)

    def to_json(self) -> str:
        """Counts and medians as JSON text; the maps themselves stay in the store."""
        good = self.identified
        medians = {
            name: {
                "unit": self.units[name],
                "median": _median(self.maps[name][good]),
                "median_standard_error": _median(self.maps[f"{name}_standard_error"][good]),
                "percentiles_5_95": _percentiles(self.maps[name][good]),
            }
            for name in self.names
        }
        content = {
            "maps": self.path,
            "run": self.run,
            "pixels": {MEANINGS[status]: count for status, count in self.counts().items()},
            "beyond_noise": int(np.count_nonzero(self.beyond_noise)),
            "parameters": medians,
            "rms_residual_MPa": _median(self.maps["rms_residual"][good]),
            "noise_MPa": _median(self.maps["noise"][good]),
            "blocks": {"done": self.blocks_done, "all": self.blocks},
            "cpu_seconds": self.cpu_seconds,
            "closeness": [vars(each) for each in self.closeness],
        }
        return json_answer("probation.field/1", content)

    def counts(self) -> dict[Status, int]:
        """Pixels of each status that there is."""
        found, numbers = np.unique(self.maps["status"], return_counts=True)
        return {Status(int(each)): int(number) for each, number in zip(found, numbers, strict=True)}


def open_maps(path: str | os.PathLike[str]) -> FieldMaps:
    """Read the maps that `identify_field` wrote, those of a run that is not finished, too.

    Raises
    ------
    InputError
        If `path` is no store of maps.
    """
    where = str(Path(path).absolute())
    if not Path(where).exists():
        raise InputError(f"{path}: found no such folder, expected maps as probation field identify writes them")
    run = read_run(where)
    group = load("zarr").open_group(where, mode="r")
    maps, units = {}, {}
    for name, array in group.arrays():
        if array.metadata.dimension_names == ("y", "x"):
            maps[name] = np.asarray(array[...])
            units[name] = str(array.attrs["units"])
    rows, columns = maps["status"].shape
    axes = {name: np.asarray(group[name][...]) for name in ("y", "x") if name in group}
    unit = str(group["y"].attrs.get("units", "")) if len(axes) == 2 else ""
    done = np.asarray(group[LEDGER][...]) != 0
    return FieldMaps(
        where,
        run,
        maps,
        units,
        axes["y"] if len(axes) == 2 else np.arange(float(rows)),
        axes["x"] if len(axes) == 2 else np.arange(float(columns)),
        unit,
        float(np.asarray(group[SECONDS][...])[done].sum()),
        done.size,
        int(np.count_nonzero(done)),
    )


def _median(values: FloatArray) -> float:
    finite = values[np.isfinite(values)]
    return float(np.median(finite)) if len(finite) else float("nan")


def _percentiles(values: FloatArray) -> list[float]:
    finite = values[np.isfinite(values)]
    return [float(each) for each in np.percentile(finite, [5, 95])] if len(finite) else []
