"""Machine ``bluehill``: Instron Bluehill 2, 3 and Universal, ``Specimen_RawData_1.csv``.

Facts as ``Dimension : Width,10,mm`` or ``Specimen properties : Area,"100,0",mm^2``, an empty line, names, units in
brackets, numbers. Decimal commas stand in quotes between separating commas.

In German ``Zeit;Verlängerung;Last;Zugdehnung (Dehnung 1)``, separated by semicolons.

Format: examples of RawData files published with the R package yadbor/bluer (Robert Day, 2019), and in the README of
a converter for an Instron 5967 (decimal commas).
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("time", "total_time", "zeit"),
    "engineering_strain": (
        *("strain_1", "tensile_strain", "compressive_strain", "tensile_strain_strain_1"),
        *("axial_strain", "tensile_strain_displacement", "tensile_strain_extension", "compressive_strain_extension"),
        *("zugdehnung", "druckdehnung"),
    ),
    "displacement": (
        *("extension", "displacement", "tensile_extension", "tensile_displacement", "compressive_extension"),
        *("verlängerung", "zugverlängerung"),
    ),
    "engineering_stress": ("tensile_stress", "compressive_stress", "stress", "zugspannung", "druckspannung"),
    "force": ("load", "force", "last", "kraft"),
}
_ITS_FACTS = re.compile(
    r"^\"?(Dimension|Specimen properties|Text Inputs|General|Specimen) : \w"
    r"|\b(Tensile|Compressive) (strain|stress|extension|displacement)\b"
    r"|\b(Zug|Druck)(dehnung|spannung|verlängerung)\b",
    re.MULTILINE,
)

MACHINE = machine_by_headings(
    "bluehill", "Instron Bluehill raw data", lambda text: _ITS_FACTS.search(text) is not None, _HEADINGS
)
