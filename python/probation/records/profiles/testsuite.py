"""Machine ``testsuite``: MTS TestSuite CSV, and the .dat files of MTS 793.

``File Path``, ``Test``, ``Test Run``, ``Date``; names; units; numbers. In .dat files ``Data Acquisition: Timed``,
``Station Name``, ``Test File Name``, then the same.

Format: the line-by-line description in public readers of TestSuite exports (metadata in lines 1 to 4, names in 7,
units in 8, numbers from 9) and of MTS 793 .dat files (mattress creep study, "Time, Axial Force, Axial Displacement"
over "s, N, mm").
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("running_time", "time", "test_time", "total_time"),
    "engineering_strain": (
        *("axial_strain", "strain_1", "extensometer_strain", "axial_extensometer", "extensometer", "strain"),
    ),
    "displacement": ("axial_ext", "axial_extension", "axial_displacement", "crosshead", "displacement", "extension"),
    "engineering_stress": ("axial_stress", "stress"),
    "force": ("axial_force", "load", "force"),
}
_ITS_FACTS = re.compile(
    r"^MTS793\||^\"?(Test Run|Test Run Name|Data Acquisition|Station Name)\s*:|\bAxial (Force|Displacement|Strain)\b",
    re.MULTILINE | re.IGNORECASE,
)

MACHINE = machine_by_headings(
    "testsuite", "MTS TestSuite or MTS 793", lambda text: _ITS_FACTS.search(text) is not None, _HEADINGS
)
