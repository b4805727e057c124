"""What a file says of itself above its headings: facts, and the specimen's dimensions.

Laboratories write ``Gauge Length(mm) : 5.1`` in one cell, ``Dimension : Width,10,mm`` in several, or a table of
specimens with a row of names, a row of units and a row for each.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from probation.errors import InputError
from probation.records.grid import is_number
from probation.records.header import split_unit, without_brackets
from probation.records.options import with_area
from probation.records.roles import normalised
from probation.records.units import convert, measures

_NAMES = {
    "gauge_length_mm": (
        *("gauge_length", "gage_length", "initial_gauge_length", "gauge_length_l0", "gauge_length_lo", "l0", "lo"),
        *("length", "specimen_length", "messlänge", "messlaenge", "anfangsmesslänge", "messlänge_l0", "einspannlänge"),
        *("messlänge_standardweg", "einspannlänge_bei_startposition"),
        *("longueur_initiale", "longueur_de_jauge", "longueur_utile", "base_de_mesure"),
    ),
    "width_mm": ("width", "specimen_width", "b0", "breite", "probenbreite", "probenbreite_b0", "largeur"),
    "thickness_mm": (
        *("thickness", "specimen_thickness", "a0", "dicke", "probendicke", "probendicke_a0"),
        *("épaisseur", "epaisseur"),
    ),
    "diameter_mm": ("diameter", "specimen_diameter", "d0", "durchmesser", "probendurchmesser", "diamètre", "diametre"),
    "area_mm2": (
        *("area", "cross_section", "cross_sectional_area", "specimen_area", "initial_area", "s0", "section"),
        *("querschnitt", "probenquerschnitt", "querschnittsfläche", "section_initiale", "aire"),
    ),
}
_DIMENSIONS = {name: key for key, names in _NAMES.items() for name in names}
_TRAILING_NUMBER = re.compile(r"\s*([+-]?[\d.,]+(?:[eE][+-]?\d+)?)\s*(\S{0,12})\s*")


@dataclass(frozen=True)
class HeaderBlock:
    """What stands above the headings.

    Attributes
    ----------
    facts : dict of str to str
        What the file calls it, and its text.
    specimens : tuple of dict of str to float
        ``area_mm2`` and ``gauge_length_mm`` of each specimen in turn; one for all where the file has one.
    """

    facts: dict[str, str] = field(default_factory=dict)
    specimens: tuple[dict[str, float], ...] = ()

    def specimen(self, number: int) -> dict[str, float]:
        """The dimensions of a specimen, counted from 0; empty where the file does not say."""
        if len(self.specimens) == 1:
            return self.specimens[0]
        return self.specimens[number] if number < len(self.specimens) else {}


def header_block(path: Path, cells: Sequence[Sequence[str]]) -> HeaderBlock:
    """Read the rows above the headings of a table.

    Parameters
    ----------
    path : Path
    cells : sequence of sequence of str
        The rows.
    """
    rows = [[cell.strip() for cell in row] for row in cells]
    tabled = _table_of_specimens(path, rows)
    if tabled:
        return HeaderBlock(_facts(rows), tabled)
    found: dict[str, float] = {}
    for key, value, _ in sorted(filter(None, map(_dimension, rows)), key=lambda dimension: dimension[2]):
        found.setdefault(key, value)
    needed = _needed(path, found)
    return HeaderBlock(_facts(rows), (needed,) if needed else ())


def _facts(rows: Sequence[Sequence[str]]) -> dict[str, str]:
    facts: dict[str, str] = {}
    for row in rows:
        name, values = _name_and_values(row)
        if name and values:
            facts.setdefault(name, " ".join(values))
    return facts


def _name_and_values(row: Sequence[str]) -> tuple[str, list[str]]:
    """The name of a fact and the cells of its value; ``group : name`` is the name alone."""
    filled = [cell for cell in row if cell]
    if len(filled) == 1:
        name, _, value = filled[0].partition(":")
        return name.strip(), [value.strip()] if value.strip() else []
    if not filled:
        return "", []
    name = filled[0].rstrip(":").strip()
    return name.rpartition(" : ")[2].strip(), filled[1:]


def _dimension(row: Sequence[str]) -> tuple[str, float, int] | None:
    """A dimension of the specimen, such as ``Width(mm) : 2.21``, and how far its name stands down in `_NAMES`."""
    label, values = _name_and_values(row)
    if not values or len(values) > 2:
        return None
    name, unit = split_unit(label)
    key = _DIMENSIONS.get(normalised(name))
    match = _TRAILING_NUMBER.fullmatch(" ".join(values))
    if key is None or match is None:
        return None
    dimension = _in_millimetres(key, match[1], match[2] or unit or "")
    return None if dimension is None else (*dimension, _NAMES[key].index(normalised(name)))


def _in_millimetres(key: str, text: str, unit: str) -> tuple[str, float] | None:
    """The dimension in mm or mm²; None where it is no positive number, or of another unit."""
    target = "mm^2" if key == "area_mm2" else "mm"
    unit = without_brackets(unit) or target
    if not is_number(text) or not measures(unit, target):
        return None
    value = float(convert(np.array([float(text.replace(",", "."))]), unit, target)[0])
    return (key, value) if 0.0 < value < np.inf else None


def _table_of_specimens(path: Path, rows: Sequence[Sequence[str]]) -> tuple[dict[str, float], ...]:
    """Dimensions in a table: a row of names, perhaps a row of units, a row of numbers for each specimen."""
    for at, row in enumerate(rows):
        keys = {
            place: _DIMENSIONS[normalised(split_unit(cell)[0])]
            for place, cell in enumerate(row)
            if normalised(split_unit(cell)[0]) in _DIMENSIONS
        }
        if len(set(keys.values())) < 2:
            continue
        units = {place: split_unit(row[place])[1] or "" for place in keys}
        below = rows[at + 1 :]
        if below and any(place < len(below[0]) and measures(without_brackets(below[0][place]), "mm") for place in keys):
            units = {place: below[0][place] if place < len(below[0]) else "" for place in keys}
            below = below[1:]
        specimens = []
        for values in below:
            cells = {place: values[place] for place in keys if place < len(values)}
            if not cells or not all(map(is_number, cells.values())):
                break
            found = [_in_millimetres(keys[place], text, units[place]) for place, text in cells.items()]
            specimens.append(_needed(path, dict(each for each in found if each is not None)))
        if specimens:
            return tuple(specimens)
    return ()


def _needed(path: Path, found: dict[str, float]) -> dict[str, float]:
    """The section and the gauge length of what the block gives; a section given twice is the area."""
    if "area_mm2" in found or not {"width_mm", "thickness_mm"} <= set(found):
        found = {key: value for key, value in found.items() if key not in ("width_mm", "thickness_mm")}
    if "area_mm2" in found or "width_mm" in found:
        found.pop("diameter_mm", None)
    try:
        return with_area(path, found)
    except InputError:  # a section beyond all numbers: it is not needed where the file has stresses
        return {key: value for key, value in found.items() if key == "gauge_length_mm"}
