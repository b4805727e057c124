"""Which column plays which role: what the user said, else what the profile knows, else the headings."""

import re
from collections.abc import Collection, Sequence
from dataclasses import replace

from probation._complaint import bad_input, likely, listed, quoted
from probation.errors import InputError
from probation.records.header import without_brackets
from probation.records.options import ReadOptions
from probation.records.roles import (
    OPTIONAL_ROLES,
    RIVALS,
    ROLES,
    STRAIN_ROLES,
    STRESS_ROLES,
    VAGUE,
    is_further,
    normalised,
    role_in,
    role_of,
)
from probation.records.table import Column, Table
from probation.records.units import is_percent, measures

# Roles that the unit of a heading implies, where no column plays one of these already and only one has such a unit. A
# stress or a strain may be true or engineering, so its unit alone does not tell.
_ROLES_OF_UNITS = {"time": ("time",), "displacement": STRAIN_ROLES, "force": STRESS_ROLES}
_WORD_END = re.compile(r"[\s_,;:]+")


def assign_columns(table: Table, options: ReadOptions, *, with_stress: bool = True) -> dict[str, Column]:
    """Give each role its column: time, one strain, one stress, and the optional ones there are.

    Where a file offers several strains (or stresses), the truest is taken. Without stress, only time and
    a strain are asked for. A heading that ends in a unit of the role that it plays, or is one ("Kraft kN", "kN"),
    gives the column that unit.

    Raises
    ------
    InputError
        If a column named does not exist or exists twice, or a quantity has no column.
    """
    named = {role: find_column(table, label) for role, label in options.columns.items()}
    implied = implied_columns(table)
    assigned: dict[str, Column] = {}
    for group in (("time",), STRAIN_ROLES, STRESS_ROLES)[: 3 if with_stress else 2]:
        role = next((r for r in group if r in named), None) or next((r for r in group if r in implied), None)
        if options.test_rate is not None and group == ("time",):
            if role is not None:
                label = (named.get(role) or implied[role]).label
                raise InputError(
                    f"{table.path}: found the time column {quoted(label)} together with test_rate, expected one of "
                    "the two; leave test_rate out"
                )
            continue
        if role is None and options.strain_from is not None and group == STRAIN_ROLES:
            continue
        if role is None:
            raise _nothing_for(table, group)
        assigned[role] = named.get(role) or implied[role]
    for role in OPTIONAL_ROLES:
        if column := named.get(role) or implied.get(role):
            assigned[role] = column
    assigned = {role: _with_unit_of_label(role, column) for role, column in assigned.items()}
    if "time" in assigned and table.clock_times(assigned["time"]) is not None:
        assigned["time"] = replace(assigned["time"], unit="s")  # whatever the heading says of hours and minutes
    for role in options.units:
        if role not in assigned:
            raise InputError(
                f"{table.path}: units: found a unit for {quoted(role)}, expected one of {listed(assigned)}, "
                "which are read from this file"
            )
    return assigned


def implied_columns(table: Table, groups: Sequence[tuple[str, ...]] = RIVALS) -> dict[str, Column]:
    """Give the columns of the roles that the profile knows, and by the headings those of which it says nothing.

    Parameters
    ----------
    table : Table
    groups : sequence of tuple of str
        Roles of which one column is wanted.

    Raises
    ------
    InputError
        If two columns have headings of one role.
    """
    by_profile = {role: find_column(table, label) for role, label in table.roles.items()}
    open_roles = {role for rivals in groups if not set(rivals) & set(by_profile) for role in rivals}
    return by_profile | _from_headings(table, open_roles)


def _from_headings(table: Table, roles: Collection[str]) -> dict[str, Column]:
    implied: dict[str, Column] = {}
    better = {role_in(column.name, column.unit) for column in table.columns if not _is_further(column)}
    for column in table.columns:
        role = role_in(column.name, column.unit)
        if role not in roles or (_is_further(column) and role in better):
            continue
        if role in implied:
            raise bad_input(
                table.path,
                f"a second column for {role}, in addition to {quoted(implied[role].label)}",
                "one",
                row=table.header_row,
                column=column.label,
                remedy=f"choose by position: {_said(role, column.position + 1)}",
            )
        if role is not None:
            implied[role] = column
    for role, rivals in _ROLES_OF_UNITS.items():
        if role in roles and not set(rivals) & set(implied):
            headed = [column for column in table.columns if is_role_of_unit(role, column)]
            if len(headed) == 1:
                implied[role] = headed[0]
    return implied


def _is_further(column: Column) -> bool:
    role = role_in(column.name, column.unit)
    return role is not None and is_further(role, column.name)


def is_role_of_unit(role: str, column: Column) -> bool:
    """Tell whether the heading has no known name, but a unit of the role's quantity: "kN", "Load cell (kN)"."""
    unit = without_brackets(column.label) if column.unit is None else column.unit
    return role_of(column.name) is None and measures(unit, ROLES[role].unit)


def _with_unit_of_label(role: str, column: Column) -> Column:
    """Take the unit from the end of the heading, where nothing else gives it and it measures what the role needs."""
    if column.unit is not None:
        return column
    needed = ROLES[role].unit
    for text in (column.label, _WORD_END.split(column.label)[-1]):
        unit = without_brackets(text)
        if is_percent(unit) if needed == "dimensionless" else measures(unit, needed):
            return replace(column, unit=unit)
    return column


def find_column(table: Table, label: str | int) -> Column:
    """Find the column of that heading (with or without its unit, in any case) or position."""
    if isinstance(label, int):
        for column in table.columns:
            if column.position == label - 1:
                return column
        positions = f"{table.columns[0].position + 1} to {table.columns[-1].position + 1}"
        raise bad_input(table.path, f"column position {label}", f"a position from {positions}", row=table.header_row)
    wanted = " ".join(label.split())
    for matches in (
        [column for column in table.columns if column.label == wanted],
        [column for column in table.columns if column.name == wanted],
        [column for column in table.columns if normalised(column.label) == normalised(wanted)],
    ):
        if len(matches) == 1:
            return matches[0]
        if matches:
            positions = " and ".join(str(column.position + 1) for column in matches)
            raise bad_input(
                table.path,
                f"{len(matches)} columns headed {quoted(label)} (positions {positions})",
                "one",
                row=table.header_row,
                remedy="choose by position instead of heading",
            )
    raise bad_input(
        table.path,
        f"no column {quoted(label)}",
        f"one of {listed(column.label for column in table.columns)}",
        row=table.header_row,
        remedy=likely(label, [column.label for column in table.columns]),
    )


def _nothing_for(table: Table, group: tuple[str, ...]) -> InputError:
    """Complain that a quantity has no column, and point at the likeliest slip."""
    quantity = {"time": "time", "true_strain": "strain", "true_stress": "stress"}[group[0]]
    if not table.headed:
        return bad_input(
            table.path,
            f"{len(table.columns)} columns without headings",
            "headings such as time_s,true_strain,true_stress_MPa",
            row=table.row_numbers[0],
            remedy="add them, or name columns by position: columns = { time = 1, … } (--column time=1 …)",
        )
    labels = [column.label for column in table.columns]
    vague = [column.label for column in table.columns if normalised(column.name) in VAGUE.get(quantity, ())]
    remedy = (
        f"{quoted(vague[0])} may be true or engineering: say which, {_said(f'true_{quantity}')}"
        if vague
        else _likeliest_slip(labels, group)
    )
    if quantity == "time":
        remedy += '; or, of a curve without time, say test_rate = "0.001 1/s" (--test-rate)'
    return bad_input(
        table.path,
        f"no {quantity} column among {listed(labels, 'and')}",
        listed(group),
        row=table.header_row,
        remedy=remedy,
    )


def _likeliest_slip(labels: list[str], group: tuple[str, ...]) -> str:
    headings = {heading for role in group for heading in ROLES[role].headings if len(heading) > 1}
    for label in labels:
        hint = likely(normalised(label), sorted(headings))
        if hint and role_of(label) is None:
            return f"{hint[:-1]} where it says {quoted(label)}? Or name it: {_said(group[0])}"
    return f"name it: {_said(group[0])}"


def _said(role: str, label: str | int = "…") -> str:
    """How a column is named, in campaign.toml and on the command line."""
    return f"columns = {{ {role} = {label} }} (--column {role}={label})"
