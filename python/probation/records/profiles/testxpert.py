"""Machine ``testxpert``: ZwickRoell testXpert II and III in German or English; text, or a sheet a specimen.

Names such as Prüfzeit, Standardkraft, Dehnung, Standardweg, Traversenweg, in English Test time, Standard force,
Strain, Standard travel; units in the row below. Dehnung is the
engineering strain, in % or, as a change of length, in mm.

Format: the ASC export that matresdev (RWTH Aachen) reads, ``"Prüfzeit";"Standardkraft";…`` over ``"s";"N";…``; the
workbook with names, units and a sheet for each specimen that the EMMA paper's evaluation reads.
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("prüfzeit", "pruefzeit", "zeit", "test_time"),
    "engineering_strain": (
        "dehnung",
        "dehnung_1_kanal",
        "nominelle_dehnung",
        "dehnung_nominell",
        "nominaldehnung",
        "strain",
        "nominal_strain",
    ),
    "displacement": (
        "standardweg",
        "verformung",
        "weg",
        "traversenweg",
        "kolbenweg",
        "traverse_abs",
        "kolbenweg_abs",
        "standard_travel",
        "deformation",
        "crosshead_absolute",
    ),
    "engineering_stress": ("zugspannung", "spannung", "technische_spannung", "stress"),
    "force": ("standardkraft", "prüfkraft", "pruefkraft", "kraft", "standard_force", "force"),
}
_ITS_WORDS = re.compile(
    r"\b(Pr(ü|ue)fzeit|Standardkraft|Pr(ü|ue)fkraft|Standardweg|Standard force|Standard travel)\b", re.IGNORECASE
)

MACHINE = machine_by_headings(
    "testxpert", "ZwickRoell testXpert", lambda text: _ITS_WORDS.search(text) is not None, _HEADINGS
)
