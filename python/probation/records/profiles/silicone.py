"""Profile ``silicone``: Maréchal's Soft Robotics Materials Database; metadata above the headings."""

from probation.records.grid import Grid, read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.profiles.tables import table_from
from probation.records.source import Source

_ROLES = {"time": "Time (s)", "true_strain": "True Strain", "true_stress": "True Stress (MPa)"}


def recognises(source: Source) -> bool:
    """Know the first row of its metadata block."""
    return source.first_line.startswith("PARAMETER;INFO;")


def read(source: Source, options: ReadOptions) -> Reading:
    """Read the table below the metadata, and the metadata."""
    grid = read_grid(source)
    table = table_from(source, grid, options).with_roles(_ROLES)
    return Reading(tables=(table,), separator=grid.separator, metadata=_metadata(grid, table.header_row))


def _metadata(grid: Grid, header_row: int | None) -> dict[str, str]:
    above = [row for row, number in zip(grid.rows, grid.row_numbers, strict=True) if number < (header_row or 0)]
    return {row[0].strip(): row[1].strip() for row in above[1:] if len(row) > 1 and row[0].strip()}


PROFILE = Profile(
    name="silicone", title="silicone pull-to-failure with metadata block", recognises=recognises, read=read
)
