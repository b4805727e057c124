"""What a file says of itself above its headings: facts, and the specimen's dimensions.

Laboratories write ``Gauge Length(mm) : 5.1`` in one cell, ``Dimension : Width,10,mm`` in several, or a table of
specimens with a row of names, a row of units and a row for each.
"""

import math
import re
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from probation.errors import InputError
from probation.records.cell import is_number, with_point
from probation.records.header import split_unit, without_brackets
from probation.records.options import with_area
from probation.records.roles import normalised
from probation.records.units import convert, measures

_NAMES = {
    "gauge_length_mm": (
        *("gauge_length", "gage_length", "initial_gauge_length", "gauge_length_initial_value", "l0", "lo"),
        *("length", "specimen_length", "free_length", "grip_separation"),
        *("messlänge", "messlaenge", "anfangsmesslänge", "anfangslänge", "probenlänge", "messlänge_bei_start"),
        *("freie_länge", "einspannlänge", "messlänge_standardweg", "einspannlänge_bei_start"),
        "einspannlänge_bei_startposition",
        *("longueur_initiale", "longueur_de_jauge", "longueur_utile", "base_de_mesure", "longueur_libre"),
        *("gauge_length_standard_travel", "lunghezza_iniziale", "tratto_utile", "longitud_inicial"),
    ),
    "width_mm": (
        "width",
        "specimen_width",
        "b0",
        "b",
        "breite",
        "probenbreite",
        "largeur",
        "larghezza",
        "ancho",
        "anchura",
    ),
    "thickness_mm": (
        *("thickness", "specimen_thickness", "a0", "h", "dicke", "probendicke"),
        *("épaisseur", "epaisseur", "spessore", "espesor"),
    ),
    "diameter_mm": (
        "diameter",
        "specimen_diameter",
        "d0",
        "durchmesser",
        "probendurchmesser",
        "diamètre",
        "diametre",
        "diametro",
        "diámetro",
    ),
    "area_mm2": (
        *("area", "cross_section", "cross_sectional_area", "specimen_area", "initial_area", "s0", "section"),
        *(
            "querschnitt",
            "probenquerschnitt",
            "querschnittsfläche",
            "section_initiale",
            "aire",
            "sezione",
            "área",
            "sección",
        ),
    ),
}
_DIMENSIONS = {name: key for key, names in _NAMES.items() for name in names}
_SYMBOL = re.compile(r"_(l0|lo|s0|a0|b0|d0)$")  # at the end of a name: "Section initiale S0"
_REMARK = re.compile(r"^[\s#%/*]+")
_PART = re.compile(r"[;,]\s+")
_NAME_AND_NUMBER = re.compile(r"(\D*[^\d\s:=])\s*[:=]?\s*([\d.,]+)\s*(\S{1,12})")
_SIDES = re.compile(r"(\D*[^\d\s:=])\s*[:=]?\s*([\d.,]+)\s*(\S{1,4}?)?\s*[x×*]\s*([\d.,]+)\s*(\S{1,12})")
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
    cells : sequence of sequence of str
        The rows.
    """
    rows = [[cell.strip() for cell in row] for row in cells]
    tabled = _table_of_specimens(path, rows)
    if tabled:
        return HeaderBlock(_facts(rows), tabled)
    dimensions: dict[str, float] = {}
    said = [*filter(None, map(_dimension, rows)), *(dimension for row in rows for dimension in _in_remarks(row))]
    for key, value, _ in sorted(said, key=lambda dimension: dimension[2]):
        dimensions.setdefault(key, value)
    needed = _needed(path, dimensions)
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
    known = _known(name)
    match = _TRAILING_NUMBER.fullmatch(" ".join(values))
    if known is None or match is None:
        return None
    dimension = _in_millimetres(known[0], match[1], match[2] or unit or "")
    return None if dimension is None else (*dimension, known[1])


def _known(name: str) -> tuple[str, int] | None:
    """The dimension of that name, perhaps with its symbol behind it, and how far the name stands down in `_NAMES`."""
    folded = normalised(name)
    for text in (folded, _SYMBOL.sub("", folded)):
        if text in _DIMENSIONS:
            return _DIMENSIONS[text], _NAMES[_DIMENSIONS[text]].index(text)
    return None


def _in_remarks(row: Sequence[str]) -> list[tuple[str, float, int]]:
    """Dimensions in running text: ``# gauge length 33 mm, section 3.2 x 4.0 mm``."""
    said = []
    for part in (part for cell in row for part in _PART.split(_REMARK.sub("", cell))):
        if (match := _SIDES.fullmatch(part)) and (known := _known(match[1])) and known[0] == "area_mm2":
            sides = [_in_millimetres("width_mm", text, match[5]) for text in (match[2], match[4])]
            if None not in sides:
                said.append((known[0], math.prod(side[1] for side in sides if side), known[1]))
        elif (match := _NAME_AND_NUMBER.fullmatch(part)) and (known := _known(match[1])):
            dimension = _in_millimetres(known[0], match[2], match[3])
            if dimension is not None:
                said.append((*dimension, known[1]))
    return said


def _in_millimetres(key: str, text: str, unit: str) -> tuple[str, float] | None:
    """The dimension in mm or mm²; None where it is no positive number, or of another unit."""
    target = "mm^2" if key == "area_mm2" else "mm"
    unit = without_brackets(unit) or target
    if not is_number(text) or not measures(unit, target):
        return None
    number = with_point(text, "," if text.rfind(",") > text.rfind(".") else ".")
    value = float(convert(np.array([float(number)]), unit, target)[0])
    return (key, value) if 0.0 < value < np.inf else None


def _table_of_specimens(path: Path, rows: Sequence[Sequence[str]]) -> tuple[dict[str, float], ...]:
    """Dimensions in a table: a row of names, perhaps a row of units, a row of numbers for each specimen."""
    for at, row in enumerate(rows):
        keys = {place: known[0] for place, cell in enumerate(row) if (known := _known(split_unit(cell)[0])) is not None}
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
            converted = [_in_millimetres(keys[place], text, units[place]) for place, text in cells.items()]
            specimens.append(_needed(path, dict(dimension for dimension in converted if dimension is not None)))
        if specimens:
            return tuple(specimens)
    return ()


def _needed(path: Path, dimensions: dict[str, float]) -> dict[str, float]:
    """The section and the gauge length of what the block gives; a section given twice is the area."""
    if "area_mm2" in dimensions or not {"width_mm", "thickness_mm"} <= set(dimensions):
        dimensions = {key: value for key, value in dimensions.items() if key not in ("width_mm", "thickness_mm")}
    if "area_mm2" in dimensions or "width_mm" in dimensions:
        dimensions.pop("diameter_mm", None)
    try:
        return with_area(path, dimensions)
    except InputError:  # a section beyond all numbers: it is not needed where the file has stresses
        return {key: value for key, value in dimensions.items() if key == "gauge_length_mm"}
