"""Profile ``vhb``: Zhao's tests of VHB 4910; time, displacement and force under Chinese headings.

Gauge length and cross-section are implied by the data (stretch 3 at 160 mm), not stated, so reading
them from here is a warning on every record; ``specimen = { … }`` replaces them.
"""

from probation.records.grid import read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.profiles.tables import table_from
from probation.records.source import Source

_HEADINGS = "时间,位移,力"  # time, displacement, force
_ROLES = {"time": "时间", "displacement": "位移", "force": "力"}
_SPECIMEN = {"area_mm2": 22.0, "gauge_length_mm": 80.0}
"""Implied by the data; see above."""


def recognises(source: Source) -> bool:
    """Know its headings, GBK or UTF-8, in the first or second row."""
    return _HEADINGS in source.first_line


def read(source: Source, options: ReadOptions) -> Reading:
    """Read headings and units, whether or not a blank row stands above."""
    grid = read_grid(source)
    table = table_from(source, grid, options)
    return Reading(tables=(table.with_roles(_ROLES),), separator=grid.separator, specimen=_SPECIMEN)


PROFILE = Profile(name="vhb", title="VHB 4910, displacement and force", recognises=recognises, read=read)
