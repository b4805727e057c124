"""Good files of known values, in many layouts and spellings of units: what is read is right, refused, or doubted.

The other kinds ask whether the program breaks. This one asks whether it reads a wrong number: each file is made from a
known record in MPa, s, - and mm, written in other units, and says so somewhere.
"""

from __future__ import annotations

import gzip
import json
import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from fuzz.case import Case
from fuzz.content import from_bytes
from fuzz.kinds.workbook import members
from fuzz.rows import Rows
from fuzz.texts import encoded, render

if TYPE_CHECKING:
    from collections.abc import Sequence
    from random import Random

    from fuzz.content import Content

NAME, SHARE = "units", 24

SAMPLES = 12
AREA, LENGTH = 40.0, 25.0
"""Of the specimen [mm2, mm]."""

_TIME = {
    1.0: ("s", "sec", "Sec", "SEC", "S", "seconds", "Seconds", "second", "secs", "sec."),
    1e-3: ("ms", "msec", "milliseconds"),
    60.0: ("min", "Min", "MIN", "minutes", "mins"),
    3600.0: ("h", "hr", "hours", "hour", "H"),
    1e-6: ("us", "µs", "μs"),
}
_LENGTH = {
    1.0: ("mm", "MM", "millimeter", "millimetre", "mm."),
    10.0: ("cm", "CM"),
    1000.0: ("m", "meter", "metre"),
    1e-3: ("um", "µm", "μm", "micron", "microns"),
    25.4: ("in", "inch", "inches", "in.", '"'),
}
_FORCE = {
    1.0: ("N", "Newton", "newton", "newtons", "Newtons"),
    1000.0: ("kN", "KN", "Kn", "kn", "kilonewton", "kilonewtons"),
    1e-3: ("mN",),
    10.0: ("daN",),
    4.4482216152605: ("lbf", "LBF", "lbs", "lb", "pounds"),
    9.80665: ("kgf", "kg", "kp"),
    4448.2216152605: ("kip", "klbf"),
}
_STRESS = {
    1.0: ("MPa", "Mpa", "MPA", "mpa", "N/mm2", "N/mm²", "N/mm^2", "N/mm**2", "N mm-2", "N·mm⁻²", "N*mm^-2",
          "MN/m2", "MN/m²", "megapascal"),
    1e-3: ("kPa", "KPa", "kpa", "KPA", "kN/m2", "kN/m²"),
    1000.0: ("GPa", "Gpa", "GPA", "kN/mm2", "kN/mm²"),
    1e-6: ("Pa", "pa", "N/m2", "N/m^2", "N/m²"),
    0.006894757293168361: ("psi", "PSI", "Psi", "lbf/in2", "lbf/in^2"),
    6.894757293168361: ("ksi", "KSI"),
    0.1: ("bar", "Bar"),
}  # fmt: skip
_STRAIN = {
    1.0: ("-", "–", "—", "1", "mm/mm", "m/m", "in/in", "none", "strain", "abs", "-/-"),
    0.01: ("%", "pct", "percent", "Percent", "PCT", "per cent"),
    1e-3: ("‰", "mm/m"),
    1e-6: ("µε", "microstrain", "µm/m", "um/m", "ustrain", "µstrain", "ue"),
}
_TEMPERATURE = ("°C", "C", "degC", "deg C", "℃", "Celsius", "K", "°F", "F", "degF")
_SPELLINGS = {
    "time": _TIME,
    "displacement": _LENGTH,
    "force": _FORCE,
    **dict.fromkeys(("true_stress", "engineering_stress"), _STRESS),
    **dict.fromkeys(("true_strain", "engineering_strain", "stretch"), _STRAIN),
}
_NAMES = {
    "time": ("Time", "time", "t", "Elapsed Time", "Test time", "TIME"),
    "displacement": ("Displacement", "Extension", "extension", "Crosshead displacement", "Disp"),
    "force": ("Force", "Load", "force", "LOAD"),
    "true_stress": ("True stress", "true_stress", "Cauchy stress"),
    "engineering_stress": ("Engineering stress", "Nominal stress", "eng_stress"),
    "true_strain": ("True strain", "true_strain", "Hencky strain", "Log strain"),
    "engineering_strain": ("Engineering strain", "Nominal strain", "eng_strain"),
    "stretch": ("Stretch", "Stretch ratio"),
    "temperature": ("Temperature", "Temp"),
}
_FOREIGN = {
    "time": ("Zeit", "Channel 0", "Prüfzeit", "时间", "Temps"),
    "displacement": ("Weg", "Traverse", "Channel 1", "位移"),
    "force": ("Kraft", "Channel 2", "力", "Standardkraft"),
    "true_stress": ("Wahre Spannung", "sigma"),
    "engineering_stress": ("Spannung", "Rm"),
    "true_strain": ("Wahre Dehnung", "eps"),
    "engineering_strain": ("Dehnung", "ε"),
    "stretch": ("lambda", "λ"),
}
_COMPANY = (
    ("Segment", ("segments", "segment", "-", "", "#", "count"), ("1", "2")),
    ("Cycle", ("cycles", "-", "n", "count"), ("1",)),
    ("Status", ("text", "", "flag", "-"), ("OK", "run")),
    ("Voltage", ("V", "mV", "volts"), ("0.5", "0.25")),
    ("Date", ("dd.mm.yyyy", "", "ISO"), ("2020-01-01",)),
    ("Channel", ("a.u.", "arb", "raw", "counts", "digits"), ("17", "18")),
    ("Comment", ("", "free text", "none"), ("", "x")),
)
"""Columns that nobody asked for: heading, what stands in their units row, cells."""


@dataclass(frozen=True)
class _Column:
    """One column as the file has it."""

    role: str
    name: str
    unit: str
    values: list[float]


def make(chance: Random) -> Case:
    """A record of known values in one layout."""
    columns, truth = _columns(chance)
    foreign = chance.random() < 0.2
    if foreign:
        columns = [_Column(c.role, chance.choice(_FOREIGN.get(c.role, (c.name,))), c.unit, c.values) for c in columns]
    stated = chance.choice(_STATEMENTS)
    cells, first, unit_options = _cells(columns, stated, chance)
    order = list(range(max(map(len, cells))))
    options: dict[str, Any] = {"specimen": {"area_mm2": AREA, "gauge_length_mm": LENGTH}}
    if chance.random() < 0.3:
        chance.shuffle(order)
        cells = [[row[at] if at < len(row) else "" for at in order] if row else row for row in cells]
    if foreign or stated == "heading is the unit":
        options["columns"] = {column.role: order.index(at) + 1 for at, column in enumerate(columns) if column.role}
    if unit_options:
        options["units"] = unit_options
    above = _metadata(chance)
    name, content = _file(Rows([*above, *cells], first + len(above), None), chance)
    doubts = {
        quantity: [
            word
            for column in columns
            if column.role in behind
            for word in (column.role, column.name, column.unit)
            if len(word) > 1
        ]
        for quantity, behind in _BEHIND.items()
        if quantity in truth
    }
    return Case(NAME, ("read", name, json.dumps(options)), {name: content}, truth, doubts)


_STRAINS = ("true_strain", "engineering_strain", "stretch", "displacement")
_BEHIND = {
    "time": ("time",),
    "true_strain": _STRAINS,
    "true_stress": ("true_stress", "engineering_stress", "force", *_STRAINS),
    "temperature": ("temperature",),
}
_STATEMENTS = (
    "square", "round", "slash", "comma", "underscore", "space", "in", "units row", "units row", "units row",
    "bracketed row", "mixed row", "mixed row", "mixed row", "row above", "row after a blank", "heading is the unit",
    "option", "nowhere", "some nowhere", "both",
)  # fmt: skip
_FORMS = {
    "square": "{} [{}]",
    "round": "{} ({})",
    "slash": "{} / {}",
    "comma": "{}, {}",
    "underscore": "{}_{}",
    "space": "{} {}",
    "in": "{} in {}",
}


def _columns(chance: Random) -> tuple[list[_Column], dict[str, list[float]]]:
    """The columns of a record in units of their own, and the record in MPa, s and -."""
    time = [0.5 * at for at in range(SAMPLES)]
    strain = [0.01 * at for at in range(SAMPLES)]
    stress = [20.0 * (1.0 - math.exp(-at / 4.0)) for at in range(SAMPLES)]
    stretch = [math.exp(each) for each in strain]
    strain_role = chance.choice(("true_strain", "engineering_strain", "stretch", "displacement"))
    stress_role = chance.choice(("true_stress", "engineering_stress", "force"))
    measures = {
        "time": time,
        "true_strain": strain,
        "engineering_strain": [each - 1.0 for each in stretch],
        "stretch": stretch,
        "displacement": [LENGTH * (each - 1.0) for each in stretch],
        "true_stress": stress,
        "engineering_stress": stress,
        "force": [AREA * each for each in stress],
    }
    if stress_role != "true_stress":
        stress = [each * factor for each, factor in zip(stress, stretch, strict=True)]
    columns = []
    for role in ("time", strain_role, stress_role):
        factor = chance.choice(list(_SPELLINGS[role]))
        unit = chance.choice(_SPELLINGS[role][factor])
        columns.append(_Column(role, chance.choice(_NAMES[role]), unit, [each / factor for each in measures[role]]))
    truth = {"time": time, "true_strain": strain, "true_stress": stress}
    if chance.random() < 0.15:
        unit = chance.choice(_TEMPERATURE)
        truth["temperature"] = [23.0 + 0.1 * at for at in range(SAMPLES)]
        columns.append(
            _Column("temperature", "Temperature", unit, [_as_written(each, unit) for each in truth["temperature"]])
        )
    return columns, truth


def _as_written(celsius: float, unit: str) -> float:
    if unit == "K":
        return celsius + 273.15
    return celsius * 1.8 + 32.0 if "F" in unit else celsius


def _cells(columns: list[_Column], stated: str, chance: Random) -> tuple[list[list[str]], int, dict[str, str]]:
    """Headings, units and numbers; how many rows stand above the numbers; units that are said on the command line."""
    company = chance.sample(_COMPANY, chance.choice((0, 0, 1, 1, 2)) or (1 if stated == "mixed row" else 0))
    names = [column.name for column in columns] + [name for name, _, _ in company]
    units = [column.unit for column in columns]
    texts = [chance.choice(spelled) if stated == "mixed row" else "-" for _, spelled, _ in company]
    form = chance.choice(("{:.9g}", "{:.9g}", "{:.9e}", "{:.12f}"))
    data = [
        [form.format(column.values[at]) for column in columns] + [chance.choice(cells) for _, _, cells in company]
        for at in range(SAMPLES)
    ]
    row = [*units, *texts]
    options: dict[str, str] = {}
    match stated:
        case "units row" | "mixed row":
            top = [names, row]
        case "bracketed row":
            left, right = chance.choice(("[]", "()"))
            top = [names, [f"{left}{unit}{right}" for unit in row]]
        case "row above":
            top = [row, names]
        case "row after a blank":
            top = [names, [], row]
        case "heading is the unit":
            top = [row]
        case "option":
            top, options = [names], {column.role: column.unit for column in columns}
        case "nowhere":
            top = [names]
        case "some nowhere":
            top = [
                [_headed("square", c.name, c.unit) if chance.random() < 0.5 else c.name for c in columns]
                + names[len(columns) :]
            ]
        case "both":
            headed = [_headed("round", column.name, column.unit) for column in columns]
            top = [headed + names[len(columns) :], row]
        case _:
            top = [[_headed(stated, column.name, column.unit) for column in columns] + names[len(columns) :]]
    return [*top, *data], len(top), options


def _headed(form: str, name: str, unit: str) -> str:
    return _FORMS[form].format(name, unit)


def _metadata(chance: Random) -> list[list[str]]:
    """What machines write above a table."""
    rows: Sequence[list[str]] = (
        ["Specimen", "7"],
        ["Speed", "10", "mm/min"],
        ["Area", "40", "mm2"],
        ["Units", "SI"],
        ["Force", "Load cell 2"],
        ["Test date", "2020-01-01"],
        [],
    )
    return [list(row) for row in rows if chance.random() < 0.5] if chance.random() < 0.3 else []


def _file(rows: Rows, chance: Random) -> tuple[str, Content]:
    """The table in one of the formats and encodings that are read."""
    match chance.choice(
        ("comma",) * 4 + ("semicolon", "semicolon", "tab", "decimal comma", "quoted", "gz", "xlsx", "xlsx")
    ):
        case "xlsx":
            return "tension-7.xlsx", {"zip": members(rows.cells, shared=chance.random() < 0.5)}
        case "gz":
            return "tension-7.csv.gz", from_bytes(gzip.compress(render(rows).encode(), mtime=0))
        case "decimal comma":
            numbers = [
                [cell.replace(".", ",") if at >= rows.first else cell for cell in row]
                for at, row in enumerate(rows.cells)
            ]
            text = render(Rows(numbers, rows.first, None), chance.choice((";", "\t")))
        case "quoted":
            quoted = [['"' + cell.replace('"', '""') + '"' for cell in row] for row in rows.cells]
            text = "".join(",".join(row) + "\n" for row in quoted)
        case separator:
            text = render(rows, {"comma": ",", "semicolon": ";", "tab": "\t"}[separator])
    newline = chance.choice(("\n", "\n", "\r\n", "\r"))
    encoding = chance.choice(("utf-8",) * 3 + ("utf-8-sig", "utf-16", "cp1252", "gbk"))
    return "tension-7.csv", from_bytes(encoded(text.replace("\n", newline), encoding))
