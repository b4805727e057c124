"""Profile ``csv``: comma, semicolon or tab between the cells, headings found wherever they stand."""

from probation.records.grid import read_grid
from probation.records.options import ReadOptions
from probation.records.profiles.profile import Profile, Reading
from probation.records.profiles.tables import read_tables
from probation.records.source import Source


def read(source: Source, options: ReadOptions) -> Reading:
    """Read any delimited text."""
    return read_tables(source, read_grid(source), options)


PROFILE = Profile(
    name="csv",
    title="delimited text with headings",
    recognises=lambda source: True,  # the last resort
    read=read,
)
