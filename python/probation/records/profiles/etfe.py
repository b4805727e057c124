"""Profile ``etfe``: tension tests of Comitti and Bosi; no headings, 15 columns per specimen.

Strains come twice: over the section of interest (SOI) and averaged over the specimen (AVG). The SOI is read,
because the stress there belongs to the strain there; ``columns = { true_strain = "true strain AVG", … }``
reads the other. The authors' strain rate is the numerical derivative of their strain, so it is not
taken as a measured rate unless asked for: ``columns = { strain_rate = "true strain rate SOI" }``.
"""

from probation.records.cell import is_number
from probation.records.grid import read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.positional import tables_by_position
from probation.records.profiles.profile import Profile, Reading
from probation.records.source import Source

_BLOCK = (
    ("time", "s"),
    ("engineering strain SOI", "-"),
    ("engineering strain AVG", "-"),
    ("engineering stress", "MPa"),
    ("engineering transverse strain SOI", "-"),
    ("engineering transverse strain AVG", "-"),
    ("zero", None),
    ("true strain SOI", "-"),
    ("true strain AVG", "-"),
    ("true stress SOI", "MPa"),
    ("true stress AVG", "MPa"),
    ("true strain rate SOI", "1/s"),
    ("true strain rate AVG", "1/s"),
    ("true transverse strain SOI", "-"),
    ("true transverse strain AVG", "-"),
)
_ROLES = {
    "time": "time",
    "true_strain": "true strain SOI",
    "true_stress": "true stress SOI",
    "transverse_strain": "true transverse strain SOI",
}
_ZERO = 6
"""Column of each block that holds zeros only, from 0."""


def recognises(source: Source) -> bool:
    """Know numbers from the first row on, in blocks of 15 whose seventh is zero."""
    cells = source.first_line.split(",")
    blocks = [cells[start : start + len(_BLOCK)] for start in range(0, len(cells), len(_BLOCK))]
    return len(cells) % len(_BLOCK) == 0 and all(
        all(map(is_number, block)) and float(block[_ZERO]) == 0.0 for block in blocks
    )


def read(source: Source, options: ReadOptions) -> Reading:
    """Read the specimens side by side."""
    grid = read_grid(source)
    tables = tables_by_position(source, grid, _BLOCK, _ROLES, header_rows=0)
    return Reading(tables=tables, separator=grid.separator)


PROFILE = Profile(name="etfe", title="ETFE tension, specimens side by side", recognises=recognises, read=read)
