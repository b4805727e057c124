"""Machine ``kammrath-weiss``: tensile stages of Kammrath & Weiss; facts, a rule of ``=``, names with units, numbers.

The displacement is that of the stage: slack and the stage's own compliance are in it.

Format: the measured file of Gazder and Niessen (complianceCorrector, MIT licence).
"""

import re

from probation.records.profiles.machine import machine_by_headings

_HEADINGS = {
    "time": ("time",),
    "displacement": ("displacement",),
    "force": ("force",),
}
_ITS_RULE = re.compile(r"^Control Mod\s*:.*^={20,}", re.MULTILINE | re.DOTALL)

MACHINE = machine_by_headings(
    "kammrath-weiss", "Kammrath & Weiss tensile stage", lambda text: _ITS_RULE.search(text) is not None, _HEADINGS
)
