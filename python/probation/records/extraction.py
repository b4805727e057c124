"""A table's columns to checked samples in MPa, s, mm and true strain; the padding cut, every doubt noted."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from probation._complaint import bad_input, joined, listed, quoted
from probation.errors import InputError
from probation.records.assignment import assign_columns, is_role_of_unit
from probation.records.checks import find_excess, find_fault, find_short_step, refusal
from probation.records.clock import Shift
from probation.records.conversions import stretch_from, true_strain_from
from probation.records.joining import Film, join
from probation.records.made_time import parse_rate, time_along
from probation.records.options import ReadOptions
from probation.records.profiles import Reading
from probation.records.roles import OPTIONAL_ROLES, ROLES, STRAIN_ROLES, STRESS_ROLES, VAGUE, normalised
from probation.records.strain_limits import (
    expected_strain,
    impossible_sample,
    remedy_for_strain,
    stating_percent,
    strain_doubts,
)
from probation.records.table import Column, Table
from probation.records.units import convert, measures
from probation.settings.reading import READING

FloatArray = NDArray[np.float64]


@dataclass(frozen=True)
class Extraction:
    """The samples of one specimen, in internal units.

    Attributes
    ----------
    samples : dict of str to ndarray, shape (n,)
        By role, in the role's internal unit.
    true_strain : ndarray, shape (n,) [-]
    stretch : ndarray, shape (n,) [-]
    warnings : tuple of str
    clock : Shift or None
        How the clock of a strain file was set.
    """

    samples: dict[str, FloatArray]
    true_strain: FloatArray
    stretch: FloatArray
    warnings: tuple[str, ...]
    clock: Shift | None = None


@dataclass(frozen=True)
class _Raw:
    """Samples in the file's units, the file's row of each, and what was left out."""

    samples: dict[str, FloatArray]
    rows: list[int]
    notes: tuple[str, ...]


def extract(
    table: Table,
    reading: Reading,
    options: ReadOptions,
    *,
    with_stress: bool = True,
    minimum: int = READING.fewest_samples,
    film: Film | None = None,
) -> Extraction:
    """Read, check and convert the columns of one specimen.

    Parameters
    ----------
    reading : Reading
        What the profile says besides.
    with_stress : bool
        False for a strain history, which needs no stress column.
    minimum : int
        Fewest samples.
    film : Film, optional
        Another file, whose strain is taken.

    Raises
    ------
    InputError
        At the first thing that is wrong, by file, row and column.
    """
    columns = assign_columns(table, options, with_stress=with_stress)
    if options.test_rate is None:
        raw = _raw_samples(table, columns, minimum)
    else:
        raw = _with_time(table, reading, options, columns, _untimed_samples(table, columns))
        columns["time"] = Column(label="time by test_rate", name="time", unit="s", position=-1)
        _check_samples(table, columns, raw, minimum)
    samples = {
        role: _in_internal_units(table, role, columns[role], values, options) for role, values in raw.samples.items()
    }
    _check_extent(table, columns, samples)
    if film is not None:
        return _filmed(table, reading, options, columns, raw, samples, film)
    role = next(role for role in STRAIN_ROLES if role in columns)
    column = columns[role]
    stated = role in options.units or column.unit is not None
    length = dimension(table, reading, options, "gauge_length_mm", role) if role == "displacement" else None
    stretch = stretch_from(role, samples[role], length)
    _check_stretch(table, role, column, raw, stretch, stated)
    true_strain = true_strain_from(role, samples[role], length)
    _check_strain(table, role, column, raw, samples[role], true_strain, stated)
    warnings = (
        *reading.warnings,
        *raw.notes,
        *_unit_warnings(columns, options),
        *_unstated_units(table, columns, raw.samples, options),
        *_roles_of_units(table, columns, options),
        *_strain_left_aside(table, columns, options),
        *dimension_warning(table, reading, options, "gauge_length_mm", length),
        *strain_doubts(role, column, samples[role], stated),
    )
    return Extraction(samples=samples, true_strain=true_strain, stretch=stretch, warnings=warnings)


def _filmed(
    table: Table,
    reading: Reading,
    options: ReadOptions,
    columns: dict[str, Column],
    raw: _Raw,
    samples: dict[str, FloatArray],
    film: Film,
) -> Extraction:
    """The force of this file over the strain of another; a displacement here only sets the clocks."""
    measure = next(role for role in STRESS_ROLES if role in columns)
    own = next((samples[role] for role in STRAIN_ROLES if role in samples), None)
    joined = join(table.path, film, samples["time"], samples[measure], own)
    return Extraction(
        samples={name: values[joined.within] for name, values in samples.items()},
        true_strain=joined.true_strain,
        stretch=np.exp(joined.true_strain),
        warnings=(
            *reading.warnings,
            *raw.notes,
            joined.note,
            *film.warnings,
            *_unit_warnings(columns, options),
            *_unstated_units(table, columns, raw.samples, options),
        ),
        clock=joined.shift,
    )


def dimension(table: Table, reading: Reading, options: ReadOptions, key: str, role: str) -> float:
    """Look up a dimension of the specimen that a role needs.

    Raises
    ------
    InputError
        If neither the user nor the profile gives it.
    """
    stated = {**reading.specimen, **table.specimen, **options.specimen}
    value = stated.get(key)
    if value is None:
        raise InputError(
            f"{table.path}: found a {role} but no {key}, expected specimen = {{ {key} = … }} (--specimen {key}=…); "
            f"a {role} becomes true strain or stress through it"
        )
    return float(value)


def dimension_warning(
    table: Table, reading: Reading, options: ReadOptions, key: str, value: float | None
) -> tuple[str, ...]:
    """Say so where a dimension in use is the profile's and not the user's."""
    if value is None or key in {**table.specimen, **options.specimen} or key not in reading.specimen:
        return ()
    return (f"{key} = {value:g} is assumed by the profile; specimen = … replaces it",)


def _raw_samples(table: Table, columns: dict[str, Column], minimum: int) -> _Raw:
    """Read the columns, cut padding and repeated last rows, and check what remains."""
    raw = _untimed_samples(table, columns)
    _check_samples(table, columns, raw, minimum)
    return raw


def _with_time(table: Table, reading: Reading, options: ReadOptions, columns: dict[str, Column], raw: _Raw) -> _Raw:
    """Put time before the samples, by the stated rate; rows at which nothing moves are left out."""
    rate, is_speed = parse_rate(table.path, options.test_rate or "")
    role = next(role for role in STRAIN_ROLES if role in columns)
    values = _in_internal_units(table, role, columns[role], raw.samples[role], options)
    if role == "displacement" or is_speed:
        length = dimension(table, reading, options, "gauge_length_mm", role)
        values = values if role == "displacement" else length * stretch_from(role, values, length)
        rate = rate if is_speed else rate * length
    if not np.isfinite(values).all():  # `_check_samples` names the row
        return _Raw({"time": np.arange(len(values), dtype=np.float64), **raw.samples}, raw.rows, raw.notes)
    time = time_along(values, rate)
    moves = np.concatenate([[True], np.diff(time) > 0.0])
    measure = "strain" if role != "displacement" else "displacement"
    notes = [f"the file has no time: it is made of the {measure}, taken to go at {options.test_rate}"]
    if not moves.all():
        notes.append(f"left out {int((~moves).sum())} rows at which the {measure} does not change: they have no time")
    samples = {"time": time[moves], **{name: sampled[moves] for name, sampled in raw.samples.items()}}
    rows = [row for row, moved in zip(raw.rows, moves, strict=True) if moved]
    return _Raw(samples, rows, (*raw.notes, *notes))


def _untimed_samples(table: Table, columns: dict[str, Column]) -> _Raw:
    """The columns, padding and repeated last rows cut."""
    samples = {
        role: table.times(column) if role == "time" else table.numbers(column) for role, column in columns.items()
    }
    blank = [role for role in OPTIONAL_ROLES if role in samples and np.isnan(samples[role]).all()]
    notes = [f"left out {role}: its column {quoted(columns[role].label)} is empty" for role in blank]
    samples = {role: values for role, values in samples.items() if role not in blank}
    if "time" in columns and table.clock_times(columns["time"]) is not None:
        notes.append(f"column {quoted(columns['time'].label)} holds times of day: seconds since the first are read")
    stacked = np.stack(list(samples.values()))
    filled = np.flatnonzero(~np.isnan(stacked).all(axis=0))
    if not filled.size:
        raise bad_input(
            table.path, "no numbers", "at least ten rows of them", column=next(iter(columns.values())).label
        )
    end = last = int(filled[-1]) + 1
    while last > 1 and np.array_equal(stacked[:, last - 1], stacked[:, last - 2]):
        last -= 1
    if last < end:
        plural = "row" if end - last == 1 else "rows"
        repeated = table.row_numbers[last - 1]
        notes.append(f"dropped {end - last} {plural} at the end that repeat row {repeated} exactly")
    samples = {role: values[:last] for role, values in samples.items()}
    return _Raw(samples=samples, rows=table.row_numbers[:last], notes=tuple(notes))


def _check_samples(table: Table, columns: dict[str, Column], raw: _Raw, minimum: int) -> None:
    samples = raw.samples
    fault = find_fault(samples, minimum)
    if fault is None:
        return
    wrong = fault.found
    if not np.isfinite(samples[fault.quantity][fault.sample]):
        at = table.row_numbers.index(raw.rows[fault.sample])
        cell = table.cells(columns[fault.quantity])[at].strip()
        wrong = quoted(cell) if cell else "an empty cell"
    raise bad_input(
        table.path,
        wrong,
        fault.expected,
        row=raw.rows[fault.sample],
        column=columns[fault.quantity].label,
        remedy=fault.remedy,
    )


def _check_extent(table: Table, columns: dict[str, Column], samples: dict[str, FloatArray]) -> None:
    """Refuse numbers beyond what physics allows, once their unit is known."""
    if fault := find_excess(samples) or find_short_step("time", samples["time"]):
        raise refusal(table, columns, fault)


def _in_internal_units(table: Table, role: str, column: Column, values: FloatArray, options: ReadOptions) -> FloatArray:
    unit = options.units.get(role) or column.unit
    if unit is None:
        return values
    try:
        return convert(values, unit, ROLES[role].unit)
    except ValueError as failure:
        raise bad_input(
            table.path,
            str(failure),
            f"{ROLES[role].kind} for {role}",
            row=table.header_row,
            column=column.label,
            remedy=f"correct the heading, or say units = {{ {role} = … }} (--unit {role}=…)",
        ) from None


def _check_stretch(table: Table, role: str, column: Column, raw: _Raw, stretch: FloatArray, stated: bool) -> None:
    bad = np.flatnonzero(stretch <= 0)
    if bad.size:
        percent = "" if stated or role != "engineering_strain" else f"; if it is in percent, {stating_percent(role)}"
        raise bad_input(
            table.path,
            f"{raw.samples[role][bad[0]]:.10g}, a stretch of {stretch[bad[0]]:.6g}",
            "a positive stretch",
            row=raw.rows[bad[0]],
            column=column.label,
            remedy="check which strain measure, unit and gauge length this column has" + percent,
        )


def _check_strain(
    table: Table, role: str, column: Column, raw: _Raw, values: FloatArray, true_strain: FloatArray, stated: bool
) -> None:
    bad = impossible_sample(role, values, true_strain, stated)
    if bad is not None:
        unit = f" {column.unit}" if column.unit else "" if stated else " without a unit"
        raise bad_input(
            table.path,
            f"{role.replace('_', ' ')} {raw.samples[role][bad]:.10g}{unit}",
            expected_strain(role, stated),
            row=raw.rows[bad],
            column=column.label,
            remedy=remedy_for_strain(role, stated),
        )


def _unit_warnings(columns: dict[str, Column], options: ReadOptions) -> list[str]:
    return [
        f"{role} is read in {unit!r} as given, although the file says {columns[role].unit!r}"
        for role, unit in options.units.items()
        if columns[role].unit not in (None, unit)
    ]


def _unstated_units(
    table: Table, columns: Mapping[str, Column], used: Collection[str], options: ReadOptions
) -> tuple[str, ...]:
    """Say which unit is assumed for a column that states none; a strain without unit is a number and needs none.

    Parameters
    ----------
    columns : mapping of str to Column
        By role.
    used : collection of str
        The roles that are read.
    """
    bare = {
        role: column
        for role, column in columns.items()
        if role in used and column.unit is None and role not in options.units and ROLES[role].unit != "dimensionless"
    }
    if not bare:
        return ()
    noun = "column" if len(bare) == 1 else "columns"
    labels = listed((column.label for column in bare.values()), "and")
    assumed = joined((ROLES[role].unit.replace("degC", "°C") for role in bare), "and")
    entries = ", ".join(f'{role} = "…"' for role in bare)
    return (
        f"no unit is stated for {noun} {labels} of {table.path.name}: {assumed} assumed; "
        f"if that is wrong, say units = {{ {entries} }} (--unit)",
    )


def _strain_left_aside(table: Table, columns: Mapping[str, Column], options: ReadOptions) -> tuple[str, ...]:
    """Say which column would be nearer to the specimen than the displacement that is read."""
    if "displacement" not in columns or "displacement" in options.columns or table.roles:
        return ()
    for column in table.columns:
        if normalised(column.name) in VAGUE["strain"] and measures(column.unit or "", "dimensionless"):
            return (
                f"column {quoted(column.label)} is not read, for it may be a true or an engineering strain; say "
                f"columns = {{ engineering_strain = {quoted(column.label)} }} (--column) to read it instead of the "
                "displacement",
            )
    return ()


def _roles_of_units(table: Table, columns: Mapping[str, Column], options: ReadOptions) -> list[str]:
    return [
        f"column {quoted(column.label)} is read as {role}, by its unit alone; "
        f"if that is wrong, say columns = {{ … }} (--column)"
        for role, column in columns.items()
        if role not in options.columns and not table.roles and is_role_of_unit(role, column)
    ]
