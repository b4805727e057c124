"""A field as it was measured: strain and stress of every pixel, in a zarr store or another file that xarray opens."""

from __future__ import annotations

import warnings
from dataclasses import dataclass, field
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from probation.errors import InputError
from probation.field.chunks import Region, array_of, damage, first_absent, require_chunks
from probation.field.extra import load
from probation.records.conversions import true_strain_from, true_stress_from
from probation.records.units import convert
from probation.settings.reading import READING

if TYPE_CHECKING:
    import os
    from collections.abc import Mapping

    import xarray as xr

    from probation._arrays import FloatArray

Samples: TypeAlias = NDArray[np.float32] | NDArray[np.float64]

SHOWN_REASON = 200
"""Characters of a reader's own complaint that are quoted; a codec may name itself by thousands."""

STRAINS = ("true_strain", "engineering_strain", "stretch")
STRESSES = ("true_stress", "engineering_stress", "force")
UNITS = {
    "time": "s",
    **dict.fromkeys(STRAINS, "dimensionless"),
    **dict.fromkeys(STRESSES[:2], "MPa"),
    "force": "N",
    "initial_area": "mm**2",
}
"""What may be in a field, and the unit it is converted to."""

DIMENSIONS = ("y", "x", "time")


@dataclass(frozen=True)
class FieldSource:
    """Where a field is and what is in it; made by `open_field`, small enough to be sent to any worker.

    Attributes
    ----------
    names : dict of str to str
        The variable of each role: a strain, a stress (or force and initial area), time.
    factors : dict of str to float
        From the unit of each to `UNITS`.
    time : ndarray, shape (n_times,) [s]
    shape : (int, int)
        Rows and columns.
    chunks : (int, int)
        Rows and columns that lie together in the file; the shape where it is not chunked.
    sparse : bool
        Whether chunks that are not there hold no data.
    """

    path: str
    names: Mapping[str, str]
    factors: Mapping[str, float]
    time: FloatArray = field(repr=False)
    shape: tuple[int, int]
    chunks: tuple[int, int]
    sparse: bool = False

    @property
    def strain_role(self) -> str:
        """Which strain there is."""
        return next(role for role in STRAINS if role in self.names)

    @property
    def stress_role(self) -> str:
        """Which stress there is, or force."""
        return next(role for role in STRESSES if role in self.names)

    def read(self, rows: slice, columns: slice) -> tuple[Samples, Samples]:
        """True strain and true stress [MPa] of a block, pixel by pixel; shape (pixels, n_times).

        Single precision stays single where nothing is converted.
        """
        with _opened(self.path) as data:
            strain = self._samples(data, self.strain_role, rows, columns)
            stress = self._samples(data, self.stress_role, rows, columns)
            if self.strain_role == "true_strain" and self.stress_role == "true_stress":
                return strain, stress
            area = None
            if self.stress_role == "force":
                area = self._samples(data, "initial_area", rows, columns)
        with np.errstate(invalid="ignore", divide="ignore"):  # a pixel without data is NaN
            true_strain = true_strain_from(self.strain_role, np.asarray(strain, dtype=np.float64))
            force = np.asarray(stress, dtype=np.float64) if area is None else np.asarray(stress / area)
            role = self.stress_role if area is None else "engineering_stress"
            return true_strain, true_stress_from(role, force, np.exp(true_strain))

    def coordinates(self) -> dict[str, tuple[FloatArray, dict[str, str]]]:
        """Positions along y and x and their attributes, of those that the field tells."""
        with _opened(self.path) as data:
            return {
                name: (
                    np.asarray(_values(self.path, data[name]), dtype=np.float64),
                    {k: str(v) for k, v in data[name].attrs.items()},
                )
                for name in ("y", "x")
                if name in data.coords and data[name].dims == (name,) and data[name].dtype.kind in "iuf"
            }

    def _samples(self, data: xr.Dataset, role: str, rows: slice, columns: slice) -> Samples:
        """Values of one variable on a block, shape (pixels, n_times), or (pixels, 1) without time."""
        variable = data[self.names[role]]
        part = variable.isel({name: at for name, at in (("y", rows), ("x", columns)) if name in variable.dims})
        sizes = (rows.stop - rows.start, columns.stop - columns.start)
        lacking = {name: size for name, size in zip(("y", "x"), sizes, strict=True) if name not in part.dims}
        part = part.expand_dims(lacking).transpose("y", "x", ...)
        sides = {"y": rows, "x": columns}
        region = tuple(sides.get(str(name), slice(0, size)) for name, size in variable.sizes.items())
        values = _values(self.path, part, region, sparse=self.sparse)
        values = values.astype(np.float32 if values.dtype == np.float32 else np.float64, copy=False)
        factor = self.factors[role]
        if factor != 1.0:
            values = values.astype(np.float64) * factor
        return np.ascontiguousarray(values.reshape(sizes[0] * sizes[1], -1))


def open_field(
    path: str | os.PathLike[str], columns: Mapping[str, str] | None = None, *, sparse: bool = False
) -> FieldSource:
    """See what a field holds, without reading its samples.

    Parameters
    ----------
    path : str or Path
        A zarr store, or a netCDF file that xarray can open. Its variables have the dimensions (y, x, time), in any
        order, and their unit in the attribute `units`; force may lack y and x, initial_area has none but them.
    columns : mapping, optional
        Which variable plays which role, where they are not named for it: ``{"true_strain": "eyy"}``. The roles are
        time; one of true_strain, engineering_strain, stretch; one of true_stress, engineering_stress, force; with
        force, initial_area.
    sparse : bool
        Whether chunks of a zarr store that are not there hold no data, as where its writer leaves out chunks of
        nothing but NaN; otherwise they are an error.

    Raises
    ------
    InputError
        Naming the file and the variable, dimension, unit or chunk, what was found and what was expected.
    """
    where = str(Path(path).absolute())
    for role in columns or {}:
        if role not in UNITS:
            raise InputError(f"columns: found the role {role!r}, expected one of {', '.join(UNITS)}")
    with _opened(where) as data:
        names = _roles(path, data, dict(columns or {}))
        factors = {role: _factor(path, role, data[name]) for role, name in names.items()}
        strain = data[names[next(role for role in STRAINS if role in names)]]
        for role, name in names.items():
            _check_dimensions(path, role, data[name], strain)
            _check_chunks(where, role, data[name], sparse=sparse)
        time = np.asarray(_values(where, data[names["time"]]), dtype=np.float64) * factors["time"]
        _check_time(path, names["time"], time)
        sizes = dict(zip(strain.dims, strain.shape, strict=True))
        chunks = strain.encoding.get("preferred_chunks") or {}
        return FieldSource(
            where,
            names,
            factors,
            time,
            (sizes["y"], sizes["x"]),
            (int(chunks.get("y", sizes["y"])), int(chunks.get("x", sizes["x"]))),
            sparse,
        )


def _opened(path: str) -> xr.Dataset:
    """The file as xarray sees it; times stay numbers."""
    xarray: Any = load("xarray")
    if not Path(path).exists():
        raise InputError(f"{path}: found no such file, expected a zarr store or a netCDF file")
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # zarr's, of entries not its own, and numpy's, of their fill values
            if Path(path).is_dir():
                load("zarr")
                opened = xarray.open_dataset(path, engine="zarr", decode_times=False, consolidated=False)
            else:
                opened = xarray.open_dataset(path, decode_times=False)
    except Exception as failure:  # whatever a reader or a codec raises
        reason = shorten(" ".join(str(failure).split()), SHOWN_REASON, placeholder=" …")
        raise InputError(f"{path}: expected a zarr store or a netCDF file that xarray opens, found: {reason}") from None
    found: xr.Dataset = opened
    return found


def _roles(path: object, data: xr.Dataset, given: dict[str, str]) -> dict[str, str]:
    """The variable of each role."""
    for role, name in given.items():
        if name not in data.variables:
            there = ", ".join(sorted(str(variable) for variable in data.variables))
            raise InputError(f"{path}: found no variable {name!r} for {role}; there are {there}")
    named_so = {role: role for role in UNITS if role in data.variables}
    names, candidates = {}, {**named_so, **given}
    for roles, what in ((STRAINS, "strain"), (STRESSES, "stress")):
        named = [role for role in roles if role in given] or [role for role in roles if role in candidates]
        if len(named) != 1:
            found = (
                " and ".join(named) or "none (" + ", ".join(sorted(str(variable) for variable in data.variables)) + ")"
            )
            raise InputError(
                f"{path}: {what}: found {found}, expected one variable named {', '.join(roles)}, or --column ROLE=NAME"
            )
        names[named[0]] = candidates[named[0]]
    for role in ("time", *(["initial_area"] if "force" in names else [])):
        if role not in candidates:
            raise InputError(f"{path}: found no variable {role}, expected it, or --column {role}=NAME")
        names[role] = candidates[role]
    return names


def _factor(path: object, role: str, variable: xr.DataArray) -> float:
    """From the variable's unit to ours."""
    unit = variable.attrs.get("units")
    if unit is None:
        if role in STRAINS:
            return 1.0
        raise InputError(f"{path}: {variable.name}: found no attribute units, expected one, such as {UNITS[role]!r}")
    try:
        return float(convert(np.array([1.0]), str(unit), UNITS[role])[0])
    except ValueError as failure:
        raise InputError(
            f"{path}: {variable.name}: found the {failure}, expected a unit like {UNITS[role]!r}"
        ) from None


def _check_dimensions(path: object, role: str, variable: xr.DataArray, strain: xr.DataArray) -> None:
    found = tuple(str(name) for name in variable.dims)
    if role == "time":
        right, expected = found == ("time",), "(time)"
    elif role == "initial_area":
        right, expected = set(found) <= {"y", "x"}, "(y, x), one of them or none"
    elif role == "force":
        right, expected = "time" in found and set(found) <= set(DIMENSIONS), "(time), and y and x at most"
    else:
        right, expected = sorted(found) == sorted(DIMENSIONS), "(y, x, time)"
    if not right:
        raise InputError(f"{path}: {variable.name}: found the dimensions ({', '.join(found)}), expected {expected}")
    if variable.dtype.kind not in "iuf":
        raise InputError(f"{path}: {variable.name}: found values of type {variable.dtype}, expected numbers")
    if role in STRAINS and 0 in strain.shape:
        raise InputError(f"{path}: {variable.name}: found the shape {variable.shape}, expected pixels and times")


def _check_chunks(path: str, role: str, variable: xr.DataArray, *, sparse: bool) -> None:
    """Every chunk of a zarr array there, or of those that are not, that they read as NaN."""
    if not Path(path).is_dir():
        return
    lacking = first_absent(path, str(variable.name))
    if lacking is None:
        return
    if not sparse or role == "time":
        raise InputError(
            f"{path}: {variable.name}: found no chunk {lacking}, expected it; where the writer leaves out chunks of "
            "nothing but NaN, give --sparse"
        )
    fill = array_of(path, str(variable.name)).fill_value
    if not (np.isnan(fill) or "_FillValue" in variable.encoding):
        raise InputError(
            f"{path}: {variable.name}: found no chunk {lacking}, which would read as {fill}, expected a fill value of "
            "NaN with --sparse"
        )


def _values(path: str, variable: xr.DataArray, region: Region | None = None, *, sparse: bool = False) -> NDArray[Any]:
    """The values of a variable, or of part of it; `region` says which part, as it lies in the file."""
    name, in_chunks = str(variable.name), Path(path).is_dir()
    if in_chunks and not sparse:
        require_chunks(path, name, region)
    try:
        return np.asarray(variable.values)
    except Exception as failure:  # whatever a reader or a codec raises
        if in_chunks:
            raise damage(path, name, region, failure) from None
        raise InputError(f"{path}: {name}: cannot be read: {' '.join(str(failure).split())}") from None


def _check_time(path: object, name: str, time: FloatArray) -> None:
    if len(time) < READING.fewest_samples:
        raise InputError(f"{path}: {name}: found {len(time)} instants, expected at least {READING.fewest_samples}")
    wrong = np.flatnonzero(~(np.diff(time) > 0.0))
    if not np.isfinite(time).all() or len(wrong):
        at = int(wrong[0]) + 1 if len(wrong) else int(np.flatnonzero(~np.isfinite(time))[0])
        raise InputError(
            f"{path}: {name}[{at}]: found {time[at]:g} after {time[at - 1]:g} s, expected increasing times"
        )
