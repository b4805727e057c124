"""Machine ``trapezium``: Shimadzu TRAPEZIUM 2, 3 and X, every specimen in one file.

A block of facts, a table of dimensions (names, units, a row for each specimen), then for each specimen its name,
``Time,Force,Stroke`` and ``sec,N,mm``; the specimens one below the other, or side by side.

Format: the description of blocks in the public readers of Trapezium files by S. Nakagawa (AGS-X, EZ-L).
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("time", "時間"),
    "engineering_strain": ("extensometer_strain", "strain", "ひずみ"),
    "displacement": ("extensometer", "extensometer1", "ext_1", "ext", "disp", "stroke", "ストローク", "変位"),
    "engineering_stress": ("stress", "応力"),
    "force": ("force", "試験力", "荷重"),
}
_ITS_HEADINGS = re.compile(r"(^|\t)(Stroke|ストローク)(\t|$)", re.MULTILINE)

MACHINE = machine_by_headings(
    "trapezium", "Shimadzu TRAPEZIUM", lambda text: _ITS_HEADINGS.search(text) is not None, _HEADINGS
)
