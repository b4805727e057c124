"""Machine ``catman``: HBM catman, a workbook or text; the names of channels are the user's, their units tell the rest.

A comment, names, units, then rows of text about each channel (start, rate, hardware, sensor), then numbers.

Format: the measured workbook of Hartloper (rlmtp, MIT licence).
"""

import re
from collections.abc import Sequence

from probation.records.profiles.machine import Machine
from probation.records.roles import normalised, role_of
from probation.records.table import Column
from probation.records.units import measures

_UNITS = {
    "force": "N",
    "displacement": "mm",
    "engineering_stress": "MPa",
    "engineering_strain": "dimensionless",
    "temperature": "degC",
}
_FEEDBACK = re.compile(r"extenso|clip|dms|sg\b|strain", re.IGNORECASE)
_ITS_FACTS = re.compile(r"Hardware channel:|Hardware-Kanal:|^(Time|Zeit)\s+\d+ - |catman", re.MULTILINE | re.IGNORECASE)


def _roles(columns: Sequence[Column]) -> dict[str, int]:
    """The first channel of each unit, one that is called an extensometer before others."""
    roles: dict[str, int] = {}
    if columns and normalised(columns[0].name).startswith(("time", "zeit", "temps")):
        roles["time"] = columns[0].position + 1
    for role, unit in _UNITS.items():
        fitting = [column for column in columns[1:] if column.unit and measures(column.unit, unit)]
        fitting.sort(key=lambda column: (role_of(column.name) != role, _FEEDBACK.search(column.name) is None))
        if fitting:
            roles[role] = fitting[0].position + 1
    return roles


MACHINE = Machine(
    name="catman",
    title="HBM catman",
    recognises=lambda text: _ITS_FACTS.search(text) is not None,
    roles=_roles,
    headings=frozenset({"time_1_default_sample_rate", "load", "force", "temperature", "zeit_1_standardmessrate"}),
    notes_below=True,
)
