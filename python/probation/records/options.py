"""How a file is to be read, where its content alone does not say."""

from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path

from probation._complaint import quoted, suggestion
from probation.errors import InputError
from probation.records.roles import ROLES, STRAIN_ROLES, STRESS_ROLES

SPECIMEN_KEYS = ("area_mm2", "gauge_length_mm")


@dataclass(frozen=True)
class ReadOptions:
    """The reading keys of a ``[[record]]``, checked.

    Attributes
    ----------
    profile : str or None
        Import profile; None recognises it from the content.
    columns : dict of str to (str or int)
        Heading, or position counted from 1, of the column for each role.
    units : dict of str to str
        Unit of the column of a role; wins over what the file says.
    specimen : dict of str to float
        ``area_mm2``, ``gauge_length_mm``.
    specimen_index : int or None
        Which of several specimens side by side, counted from 1.
    sheet : str or None
        Sheet of an Excel workbook.
    """

    profile: str | None = None
    columns: dict[str, str | int] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    specimen: dict[str, float] = field(default_factory=dict)
    specimen_index: int | None = None
    sheet: str | None = None

    @property
    def labels(self) -> list[str]:
        """The headings that the user named."""
        return [label for label in self.columns.values() if isinstance(label, str)]


def read_options(
    path: Path,
    *,
    profile: str | None,
    columns: Mapping[str, str | int] | None,
    units: Mapping[str, str] | None,
    specimen: Mapping[str, float] | None,
    specimen_index: int | None,
    sheet: str | None,
) -> ReadOptions:
    """Check the keywords of a reading function.

    Raises
    ------
    InputError
        If a key is unknown, a value impossible, or two columns compete for one quantity.
    """
    columns, units, specimen = dict(columns or {}), dict(units or {}), dict(specimen or {})
    _only_known(path, "columns", columns, ROLES)
    _only_known(path, "units", units, ROLES)
    _only_known(path, "specimen", specimen, SPECIMEN_KEYS)
    for group in (STRAIN_ROLES, STRESS_ROLES):
        rivals = [role for role in group if role in columns]
        if len(rivals) > 1:
            raise InputError(
                f"{path}: columns: found both {rivals[0]!r} and {rivals[1]!r}, expected one of them; drop one"
            )
    for role, label in columns.items():
        if isinstance(label, bool) or not isinstance(label, str | int) or label in ("", 0):
            raise InputError(
                f"{path}: columns.{role}: found {label!r}, expected a heading or a position counted from 1"
            )
    for key, value in specimen.items():
        if isinstance(value, bool) or not isinstance(value, int | float) or not 0 < value < float("inf"):
            raise InputError(f"{path}: specimen.{key}: found {value!r}, expected a positive number")
    return ReadOptions(
        profile=profile,
        columns=columns,
        units=units,
        specimen=specimen,
        specimen_index=specimen_index,
        sheet=sheet,
    )


def _only_known(path: Path, what: str, given: Mapping[str, object], known: Collection[str]) -> None:
    for key in given:
        if key not in known:
            raise InputError(f"{path}: {what}: found the unknown key {quoted(key)}; {suggestion(key, known)}")
