"""A file opened and recognised, its columns found: what records and strain histories have in common."""

from pathlib import Path

from probation._complaint import bad_input, quoted
from probation.errors import InputError
from probation.records.options import ReadOptions
from probation.records.profiles import Profile, Reading, find_profile
from probation.records.profiles.excel import recognises as is_workbook
from probation.records.source import Source
from probation.records.table import Table


def several_specimens(path: Path, count: int) -> InputError:
    """Build the error for a file of several specimens where one is wanted."""
    return bad_input(
        path,
        f"{count} specimens side by side",
        "a choice",
        remedy=f"say specimen_index = 1 … {count} (--specimen-index)",
    )


def open_file(path: Path, options: ReadOptions) -> tuple[Source, Profile, Reading]:
    """Open a file, recognise it, and find its columns."""
    source = Source.open(path)
    profile = find_profile(source, options.profile)
    if options.sheet is not None and not is_workbook(source):
        raise InputError(f"{path}: found sheet = {quoted(options.sheet)} for a text file, expected none; drop it")
    reading = profile.read(source, options)
    return source, find_profile(source, reading.machine) if reading.machine else profile, reading


def chosen_tables(path: Path, reading: Reading, specimen_index: int | None) -> list[tuple[int, Table]]:
    """Pick the specimens asked for, each with its number in the file."""
    numbered = list(enumerate(reading.tables, start=1))
    if specimen_index is None:
        return numbered
    if isinstance(specimen_index, bool) or not 1 <= specimen_index <= len(numbered):
        held = f"{len(numbered)} specimens" if len(numbered) > 1 else "1 specimen"
        raise InputError(
            f"{path}: specimen_index: found {specimen_index!r}, expected at most {len(numbered)} "
            f"and counted from 1; the file holds {held}"
        )
    return [numbered[specimen_index - 1]]
