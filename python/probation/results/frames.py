"""Columns to the data structures of pandas and xarray."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from probation.results.extras import needed

if TYPE_CHECKING:
    from collections.abc import Mapping, Sequence


def data_frame(columns: Mapping[str, Any]) -> Any:
    """A pandas DataFrame of columns of one length.

    Raises
    ------
    InputError
        Where pandas is not installed.
    """
    return needed("pandas", "to_dataframe").DataFrame(dict(columns))


def rows_frame(rows: Sequence[Mapping[str, Any]], columns: Sequence[str]) -> Any:
    """A pandas DataFrame of rows, with these columns even where there are none.

    Raises
    ------
    InputError
        Where pandas is not installed.
    """
    return needed("pandas", "to_dataframe").DataFrame(list(rows), columns=list(columns))


def by_record(parts: Mapping[str, Mapping[str, Any]]) -> Any:
    """One below the other, with a first column "record"; what a record does not have is NaN.

    Raises
    ------
    InputError
        Where pandas is not installed.
    """
    pandas = needed("pandas", "to_dataframe")
    frames = [pandas.DataFrame({"record": name, **columns}) for name, columns in parts.items()]
    return pandas.concat(frames, ignore_index=True)


def over_samples(parts: Mapping[str, Mapping[str, Any]]) -> Any:
    """An xarray Dataset over "sample", record after record, with the coordinates "record" and "time_s".

    Records differ in length and in their instants, so that these are no axes of their own:
    ``found.where(found["record"] == "slow", drop=True)`` is one of them.

    Raises
    ------
    InputError
        Where xarray is not installed.
    """
    names = next(iter(parts.values()))
    columns = {
        name: ("sample", np.concatenate([np.broadcast_to(part[name], len(part["time_s"])) for part in parts.values()]))
        for name in names
    }
    record = np.repeat(list(parts), [len(part["time_s"]) for part in parts.values()])
    coordinates = {"record": ("sample", record), "time_s": columns.pop("time_s")}
    return needed("xarray", "to_xarray").Dataset(columns, coords=coordinates)


def over_time(columns: Mapping[str, Any]) -> Any:
    """An xarray Dataset over the coordinate "time_s", which is one of the columns.

    Raises
    ------
    InputError
        Where xarray is not installed.
    """
    values = {name: ("time_s", column) for name, column in columns.items() if name != "time_s"}
    return needed("xarray", "to_xarray").Dataset(values, coords={"time_s": columns["time_s"]})
