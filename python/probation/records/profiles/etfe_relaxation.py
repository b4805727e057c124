"""Profile ``etfe_relaxation``: Comitti and Bosi's relaxation tests, 9 columns per specimen.

The file's headings are misaligned: the four from the sixth on are named strain, stress, rate and transverse
strain but hold time, strain, stress and rate. So the columns are taken by position and the
headings only serve to recognise the file. The rate is the numerical derivative of the strain and is
not taken as a measured one.
"""

from probation.records.grid import read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.positional import tables_by_position
from probation.records.profiles.profile import Profile, Reading
from probation.records.source import Source

_BLOCK = (
    ("time", "s"),
    ("engineering strain", "-"),
    ("engineering stress", "MPa"),
    ("engineering transverse strain", "-"),
    ("zero", None),
    ("hold time", "s"),  # headed exxHencky01SOI
    ("true strain", "-"),  # headed StressTrue01AVG
    ("true stress", "MPa"),  # headed SR0Hencky1AVG
    ("true strain rate", "1/s"),  # headed eyyHencky01AVG
)
_ROLES = {"time": "time", "true_strain": "true strain", "true_stress": "true stress"}


def recognises(source: Source) -> bool:
    """Know its own headings: nine per specimen, the sixth claiming to be a Hencky strain."""
    cells = [cell.strip() for cell in source.first_line.split(",")]
    return len(cells) % len(_BLOCK) == 0 and cells[0] == "t01" and cells[5].startswith("exxHencky")


def read(source: Source, options: ReadOptions) -> Reading:
    """Read the specimens side by side, by position."""
    grid = read_grid(source)
    tables = tables_by_position(source, grid, _BLOCK, _ROLES, header_rows=1)
    note = "the headings of this file are misaligned; its columns are read by position"
    return Reading(tables=tables, separator=grid.separator, warnings=(note,))


PROFILE = Profile(
    name="etfe_relaxation",
    title="ETFE relaxation, specimens side by side, misaligned headings",
    recognises=recognises,
    read=read,
)
