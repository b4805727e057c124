"""Machine ``testxpert``: ZwickRoell testXpert II and III in German; text with decimal commas, or a sheet a specimen.

Names such as Prüfzeit, Standardkraft, Dehnung, Standardweg, Traversenweg; units in the row below. Dehnung is the
engineering strain, in % or, as a change of length, in mm.

Format: the ASC export that matresdev (RWTH Aachen) reads, ``"Prüfzeit";"Standardkraft";…`` over ``"s";"N";…``; the
workbook with names, units and a sheet for each specimen that the EMMA paper's evaluation reads.
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("prüfzeit", "pruefzeit", "zeit", "test_time"),
    "engineering_strain": ("dehnung", "dehnung_1_kanal", "nominelle_dehnung", "dehnung_nominell", "nominaldehnung"),
    "displacement": ("standardweg", "verformung", "weg", "traversenweg", "kolbenweg", "traverse_abs", "kolbenweg_abs"),
    "engineering_stress": ("zugspannung", "spannung", "technische_spannung"),
    "force": ("standardkraft", "prüfkraft", "pruefkraft", "kraft"),
}
_ITS_WORDS = re.compile(r"\b(Pr(ü|ue)fzeit|Standardkraft|Pr(ü|ue)fkraft|Standardweg)\b", re.IGNORECASE)

MACHINE = machine_by_headings(
    "testxpert", "ZwickRoell testXpert, in German", lambda text: _ITS_WORDS.search(text) is not None, _HEADINGS
)
