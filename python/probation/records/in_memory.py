"""Arrays and data frames to records, by the same checks and conversions as files."""

from collections.abc import Callable, Collection, Iterable, Mapping
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from probation._complaint import bad_input, listed, quoted, suggestion
from probation.errors import InputError
from probation.records.assembly import assemble
from probation.records.header import split_unit
from probation.records.options import read_options
from probation.records.profiles import Reading
from probation.records.record import Noise, Record
from probation.records.roles import ROLES
from probation.records.start import STARTS
from probation.records.table import Column, FloatArray, Table

Value = TypeVar("Value")


@dataclass(frozen=True)
class ColumnsInMemory(Table):
    """A table whose cells are arrays; rows are counted from 1.

    Attributes
    ----------
    values : dict of str to ndarray
        By the column's label.
    """

    values: Mapping[str, FloatArray] = field(default_factory=dict)

    @property
    def headed(self) -> bool:
        """Its columns always have names."""
        return True

    def cells(self, column: Column) -> list[str]:
        """What the samples are, as text."""
        return [str(value) for value in self.values[column.label].tolist()]

    def numbers(self, column: Column) -> FloatArray:
        """The samples, shape (n_rows,) [the column's unit]."""
        return self.values[column.label]


def records_from_arrays(
    arrays: Mapping[str, ArrayLike],
    *,
    record: str | Iterable[object],
    units: Mapping[str, str] | None,
    specimen: Mapping[str, Any] | None,
    **said: Any,
) -> tuple[Record, ...]:
    """Records of arrays by role; `Campaign.from_arrays` says the arguments."""
    place = Path("from_arrays")
    given = {role: values for role, values in arrays.items() if values is not None}
    values = {role: _samples(place, role, values, "argument") for role, values in given.items()}
    stated = units or {}
    columns = {role: Column(role, role, stated.get(role, ROLES[role].unit), at) for at, role in enumerate(values)}
    names = None if isinstance(record, str) else _names(place, "record", record)
    return _records(
        place,
        columns,
        values,
        names=[str(record)] * len(values["time"]) if names is None else names,
        named="time" if names is None else "record",
        columns_of={role: role for role in values},
        units=units,
        specimen=specimen,
        said=said,
    )


def records_from_frame(
    frame: Any,
    *,
    record: str | None,
    name: str,
    columns: Mapping[str, str | int] | None,
    units: Mapping[str, str] | None,
    specimen: Mapping[str, Any] | None,
    **said: Any,
) -> tuple[Record, ...]:
    """Records of anything with columns; `Campaign.from_dataframe` says the arguments."""
    place = Path("from_dataframe")
    labels = _labels(place, frame)
    if record is not None and record not in labels:
        raise bad_input(place, f"no column {quoted(str(record))} for record", f"one of {listed(labels)}")
    known = {}
    for at, label in enumerate(labels):
        if label != record:
            known[label] = Column(label, *split_unit(label), position=at)
    values = _Lazily(lambda label: _samples(place, label, frame[label], "column"))
    length = len(frame[labels[0]])
    return _records(
        place,
        known,
        values,
        names=[name] * length if record is None else _names(place, record, frame[record]),
        named=labels[0] if record is None else record,
        columns_of=columns,
        units=units,
        specimen=specimen,
        said=said,
    )


class _Lazily(dict[str, FloatArray]):
    """Columns that are read when they are asked for: a frame may also hold text."""

    def __init__(self, read: Callable[[str], FloatArray]) -> None:
        super().__init__()
        self.read = read

    def __missing__(self, label: str) -> FloatArray:
        self[label] = self.read(label)
        return self[label]


def _records(
    place: Path,
    columns: Mapping[str, Column],
    values: Mapping[str, FloatArray],
    *,
    names: list[str],
    named: str,
    columns_of: Mapping[str, str | int] | None,
    units: Mapping[str, str] | None,
    specimen: Mapping[str, Any] | None,
    said: Mapping[str, Any],
) -> tuple[Record, ...]:
    """One record for each of the names, in the order in which they appear."""
    rows: dict[str, list[int]] = {}
    for at, name in enumerate(names):
        rows.setdefault(name, []).append(at)
    if not rows:
        raise bad_input(place, "no rows", "at least ten")
    each_specimen = _by_record(place, "specimen", specimen or {}, rows, nested=True)
    each_said = {key: _by_record(place, key, value, rows) for key, value in said.items() if value is not None}
    for start in each_said.get("start", {}).values():
        if start not in STARTS:
            raise InputError(f"{place}: start: found {start!r}; {suggestion(str(start), STARTS)}")
    for noise in each_said.get("noise", {}).values():
        if not isinstance(noise, Noise):
            raise InputError(
                f"{place}: noise: found {noise!r}, expected a probation.Noise, such as Noise(stress_MPa=0.04)"
            )
    records = []
    for name, taken in rows.items():
        options = read_options(place, columns=columns_of, units=units, specimen=each_specimen.get(name))
        picked = _Lazily(partial(_taken, place, values, taken, f"{len(names)}, as many as {named}"))
        table = ColumnsInMemory(
            path=place if len(rows) == 1 else Path(f"{place}, record {quoted(name)}"),
            columns=tuple(columns.values()),
            rows=[[]] * len(taken),
            row_numbers=[at + 1 for at in taken],
            header_row=None,
            values=picked,
        )
        keys = {key: value[name] for key, value in each_said.items() if name in value}
        records.append(
            assemble(
                None,
                "",
                Reading(tables=(table,), separator=""),
                table,
                options,
                record_id=name,
                **keys,
            )
        )
    return tuple(records)


def _taken(place: Path, values: Mapping[str, FloatArray], rows: list[int], expected: str, label: str) -> FloatArray:
    samples = values[label]
    if len(samples) != int(expected.partition(",")[0]):
        raise bad_input(place, f"{len(samples)} samples of {label}", expected)
    return samples[rows]


def _by_record(
    place: Path, argument: str, value: Any, names: Collection[str], *, nested: bool = False
) -> dict[str, Any]:
    """An argument for each record: one value for all, or a mapping by the record's name."""
    keys = set(value) if isinstance(value, Mapping) else set()
    by_name = any(isinstance(entry, Mapping) for entry in value.values()) if nested else bool(keys)
    if not by_name:
        return dict.fromkeys(names, value)
    for key in value:
        if key not in names:
            raise InputError(f"{place}: {argument}: found the record {key!r}; {suggestion(str(key), names)}")
    return dict(value)


def _labels(place: Path, frame: Any) -> list[str]:
    """Names of the columns of a data frame, a mapping of arrays or a structured array."""
    dtype_names = getattr(getattr(frame, "dtype", None), "names", None)
    names = dtype_names or getattr(frame, "columns", None)
    if names is None and isinstance(frame, Mapping):
        names = frame.keys()
    if names is None:
        kind = type(frame).__name__
        raise bad_input(place, f"a value of type {kind}", "a data frame, or a mapping of names to arrays")
    labels = list(names)
    for label in labels:
        if not isinstance(label, str):
            raise bad_input(place, f"the column name {label!r}", "names that are text", remedy="rename the columns")
    repeated = [label for label in labels if labels.count(label) > 1]
    if repeated or not labels:
        fault = f"two columns named {quoted(repeated[0])}" if repeated else "no columns"
        raise bad_input(place, fault, "one column of each name")
    return labels


def _names(place: Path, label: str, values: Iterable[object]) -> list[str]:
    """The record of each row, as text; whole numbers as such."""
    names = []
    for at, value in enumerate(np.asarray(values, dtype=object).ravel().tolist()):
        if str(value).strip() in ("", "None", "nan", "<NA>", "NaT"):
            raise bad_input(place, "no name of a record", "one in every row", row=at + 1, column=label)
        names.append(str(int(value)) if isinstance(value, float) and value.is_integer() else str(value))
    return names


def _samples(place: Path, label: str, values: Any, what: str) -> FloatArray:
    """Samples as float64; NaN where one is missing."""
    if isinstance(values, np.ma.MaskedArray):
        values = np.ma.filled(values.astype(np.float64), np.nan)
    given: NDArray[Any] = np.asarray(values)
    if given.ndim != 1:
        raise bad_input(place, f"the shape {given.shape}", "(n_times,)", column=label)
    if given.dtype.kind in "biuf":
        return np.array(given, dtype=np.float64)
    if given.dtype.kind not in "OUST":
        remedy = "subtract the first and divide by a second" if given.dtype.kind in "mM" else ""
        raise bad_input(place, f"values of type {given.dtype}", "real numbers", column=label, remedy=remedy)
    samples = np.full(len(given), np.nan)
    for at, value in enumerate(given.tolist()):
        try:
            missing = value is None or type(value).__name__ in ("NAType", "NaTType")
            samples[at] = np.nan if missing else float(value)
        except (TypeError, ValueError, OverflowError):
            raise bad_input(
                place, quoted(str(value)), "a number", row=at + 1, column=label, remedy=f"correct the {what}"
            ) from None
    return samples
