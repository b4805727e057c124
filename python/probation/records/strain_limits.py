"""How large a strain can be, and from where on a column without a unit is taken to be in percent."""

import numpy as np
from numpy.typing import NDArray

from probation._complaint import quoted
from probation.records.table import Column

FloatArray = NDArray[np.float64]

# A stretch of 148. Superplastic metals reach 80, elastomers 5 to 15.
LARGEST_TRUE_STRAIN = 5.0

_QUESTIONED = {"true_strain": 2.5, "engineering_strain": 5.0, "stretch": 12.0}
"""Values [-] from which on a column that states no unit is questioned: elastomers reach engineering strains above 5."""
_REFUSED = {"engineering_strain": 20.0, "stretch": 21.0}
"""... and from which on it is refused: no elastomer bears as much, a value without unit is a percentage."""


def impossible_sample(role: str, values: FloatArray, true_strain: FloatArray, stated: bool) -> int | None:
    """Find the first sample that no specimen can have reached, or that must be in percent.

    Parameters
    ----------
    role : {"true_strain", "engineering_strain", "stretch", "displacement"}
    values : ndarray, shape (n,)
        As measured, in the role's internal unit.
    true_strain : ndarray, shape (n,) [-]
        What it becomes.
    stated : bool
        Whether the file or the user states the unit.

    Returns
    -------
    int or None
        Index of the sample; None where all are possible.
    """
    impossible = np.abs(true_strain) > LARGEST_TRUE_STRAIN
    if not stated and role in _REFUSED:
        impossible |= values > _REFUSED[role]
    indices = np.flatnonzero(impossible)
    return int(indices[0]) if indices.size else None


def expected_strain(role: str, stated: bool) -> str:
    """Say what was expected in place of an impossible sample."""
    if not stated and role in _REFUSED:
        return f"at most {_REFUSED[role]:g} where no unit is stated"
    return f"at most {LARGEST_TRUE_STRAIN:g} as true strain, a stretch of {np.exp(LARGEST_TRUE_STRAIN):.0f}"


def remedy_for_strain(role: str, stated: bool) -> str:
    """Say how to state percent, the likeliest slip, or what else to check."""
    if role == "displacement":
        return "check its unit and gauge_length_mm"
    if stated:
        return "check its unit"
    as_it_is = f'; if not, units = {{ {role} = "-" }}' if role in _REFUSED else ""
    return f"if it is in percent, {stating_percent(role)}{as_it_is}"


def stating_percent(role: str) -> str:
    """Say how percent is stated: in the campaign, in the file, on the command line."""
    return f'say units = {{ {role} = "%" }}, head the column "{role} (%)", or preview with --unit {role}=%'


def strain_doubts(role: str, column: Column, values: FloatArray, stated: bool) -> tuple[str, ...]:
    """Question strains without a stated unit that are possible but rare; arguments as in `impossible_sample`."""
    largest = float(np.abs(values).max())
    if stated or largest <= _QUESTIONED.get(role, np.inf):
        return ()
    return (
        f"strain in percent? column {quoted(column.label)} states no unit and reaches {largest:.4g}; "
        f"if so, {stating_percent(role)}",
    )
