"""How a file is to be read, where its content alone does not say."""

import math
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import TypedDict, Unpack

from probation._complaint import listed, quoted, suggestion
from probation.errors import InputError
from probation.limits import LARGEST_DIMENSION, SMALLEST_DIMENSION
from probation.records.made_time import parse_rate
from probation.records.roles import ROLES, STRAIN_ROLES, STRESS_ROLES

SPECIMEN_KEYS = ("area_mm2", "gauge_length_mm", "width_mm", "thickness_mm", "diameter_mm")


class ReadingKeys(TypedDict, total=False):
    """The keywords that say how a file is read: of `preview`, `read_records`, `Campaign.from_files`; all optional.

    Attributes
    ----------
    profile : str
        Import profile; by default recognised from the content.
    columns : mapping of str to (str or int)
        Heading (or position counted from 1) of the column for each role: ``time``; one of
        ``true_strain``, ``engineering_strain``, ``stretch``, ``displacement``; one of ``true_stress``,
        ``engineering_stress``, ``force``; optionally ``strain_rate``, ``transverse_strain``, ``temperature``.
        By default found by the headings.
    units : mapping of str to str
        Unit of the column of a role, e.g. ``{"force": "kN"}``; wins over the file's. A column
        without any unit is taken in s, -, MPa, mm, N, 1/s or °C.
    specimen : mapping of str to float
        ``area_mm2``, or ``width_mm`` and ``thickness_mm``, or ``diameter_mm`` (for a force), and
        ``gauge_length_mm`` (for a displacement); wins over the file's.
    specimen_index : int
        Only this one of several specimens of a file, counted from 1.
    sheet : str
        Sheet of an Excel workbook; by default the first that holds anything.
    test_rate : str
        For a file without time: the rate at which its strain went (``"0.001 1/s"``), or its crosshead
        (``"2 mm/min"``, by ``gauge_length_mm``).
    strain_from : mapping
        The strain from another file, on its own clock: ``file`` (relative to this one), ``shift_s`` (added to its
        time; estimated where left out), and ``columns``, ``units``, ``specimen``, … of that file.
    """

    profile: str | None
    columns: Mapping[str, str | int] | None
    units: Mapping[str, str] | None
    specimen: Mapping[str, float] | None
    specimen_index: int | None
    sheet: str | None
    test_rate: str | None
    strain_from: Mapping[str, object] | None


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
    test_rate : str or None
        Rate at which a file without time was driven.
    strain_from : mapping or None
        The file of the strain, its shift, and how it is read.
    """

    profile: str | None = None
    columns: dict[str, str | int] = field(default_factory=dict)
    units: dict[str, str] = field(default_factory=dict)
    specimen: dict[str, float] = field(default_factory=dict)
    specimen_index: int | None = None
    sheet: str | None = None
    test_rate: str | None = None
    strain_from: Mapping[str, object] | None = None

    @property
    def labels(self) -> list[str]:
        """The headings that the user named."""
        return [label for label in self.columns.values() if isinstance(label, str)]


def read_options(path: Path, **how: Unpack[ReadingKeys]) -> ReadOptions:
    """Check the keywords of a reading function.

    Raises
    ------
    InputError
        If a key is unknown, a value impossible, or two columns compete for one quantity.
    """
    columns, units = dict(how.get("columns") or {}), dict(how.get("units") or {})
    specimen = dict(how.get("specimen") or {})
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
        number = not isinstance(value, bool) and isinstance(value, int | float)
        if not number or not SMALLEST_DIMENSION <= value <= LARGEST_DIMENSION:
            raise InputError(
                f"{path}: specimen.{key}: found {value!r}, expected a positive number "
                f"from {SMALLEST_DIMENSION:g} to {LARGEST_DIMENSION:g}"
            )
    return ReadOptions(
        profile=how.get("profile"),
        columns=columns,
        units=units,
        specimen=with_area(path, specimen),
        specimen_index=how.get("specimen_index"),
        sheet=how.get("sheet"),
        test_rate=_rate(path, how.get("test_rate")),
        strain_from=how.get("strain_from") or None,
    )


def _rate(path: Path, text: str | None) -> str | None:
    if text is not None:
        parse_rate(path, text)
    return text


def with_area(path: Path, specimen: Mapping[str, float]) -> dict[str, float]:
    """The dimensions that a record needs: the section from width and thickness, or from the diameter.

    Raises
    ------
    InputError
        If one side of a rectangle is missing, or the section is given twice.
    """
    given = [key for key in ("area_mm2", "width_mm", "thickness_mm", "diameter_mm") if key in specimen]
    needed = {key: float(value) for key, value in specimen.items() if key not in given or key == "area_mm2"}
    if given in ([], ["area_mm2"]):
        return needed
    if given == ["width_mm", "thickness_mm"]:
        area = specimen["width_mm"] * specimen["thickness_mm"]
    elif given == ["diameter_mm"]:
        area = math.pi / 4.0 * specimen["diameter_mm"] ** 2
    else:
        raise InputError(
            f"{path}: specimen: found {listed(given, 'and')}, expected area_mm2, or width_mm and thickness_mm, "
            "or diameter_mm"
        )
    if not 0.0 < area < math.inf:
        raise InputError(
            f"{path}: specimen: found a section of {area:g} mm² of {listed(given, 'and')}, expected "
            "a positive number; check the dimensions"
        )
    return {**needed, "area_mm2": area}


def _only_known(path: Path, what: str, given: Mapping[str, object], known: Collection[str]) -> None:
    for key in given:
        if key not in known:
            raise InputError(f"{path}: {what}: found the unknown key {quoted(key)}; {suggestion(key, known)}")
