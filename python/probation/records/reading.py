"""Files to records: the one way in, for campaigns, previews and scripts."""

from dataclasses import replace
from functools import partial
from os import PathLike
from pathlib import Path
from typing import Unpack

from probation._complaint import bad_input, suggestion
from probation.errors import InputError
from probation.records.assembly import assemble
from probation.records.film import read_film
from probation.records.opening import chosen_tables, open_file, several_specimens
from probation.records.options import ReadingKeys, ReadOptions, read_options
from probation.records.profiles import Profile, Reading
from probation.records.record import Noise, Record
from probation.records.source import Source
from probation.records.start import STARTS


def read_records(
    path: str | PathLike[str],
    *,
    record_id: str | None = None,
    control: str = "other",
    role: str = "identify",
    noise: Noise | None = None,
    start: str = "auto",
    **how: Unpack[ReadingKeys],
) -> tuple[Record, ...]:
    """Read every specimen of a file.

    Parameters
    ----------
    path : path-like
        CSV/TSV, .xlsx, or whatever an import profile reads; may be gzipped.
    record_id : str, optional
        By default the file's name without ending, and the specimen's number where there are several.
    control, role, noise
        As in `Record`.
    start : {"auto", "relaxed", "loaded"}
        "loaded": the record is cut at its start, and the ramp from zero strain that is missing is put before it.
    **how
        How the file is read: `options.ReadingKeys` says each.

    Returns
    -------
    tuple of Record

    Raises
    ------
    InputError
        At the first thing that is wrong, naming file, row, column, what was found and expected.
    """
    path = Path(path)
    options = read_options(path, **how)
    made = partial(assemble_all, control=control, role=role, noise=noise, start=start)
    source, profile, reading = _open_records(path, options, start)
    if len(reading.like_sheets) < 2:
        return made(source, profile, reading, options, record_id=record_id)
    records: list[Record] = []
    for sheet in reading.like_sheets:
        chosen = replace(options, sheet=sheet)
        records += made(*_open_records(path, chosen, start), chosen, record_id=f"{record_id or _stem(path)}-{sheet}")
    return tuple(records)


def _open_records(path: Path, options: ReadOptions, start: str) -> tuple[Source, Profile, Reading]:
    source, profile, reading = open_file(path, options)
    if reading.auxiliary:
        raise bad_input(path, reading.auxiliary, "a stress-strain record", remedy="name another file")
    if start not in STARTS:
        raise InputError(f"{path}: start: found {start!r}; {suggestion(start, STARTS)}")
    return source, profile, reading


def read_record(
    path: str | PathLike[str],
    *,
    record_id: str | None = None,
    control: str = "other",
    role: str = "identify",
    noise: Noise | None = None,
    start: str = "auto",
    **how: Unpack[ReadingKeys],
) -> Record:
    """Read one specimen of a file; parameters as in `read_records`. Of a workbook, one sheet is read.

    Raises
    ------
    InputError
        As `read_records`, and if the file holds several specimens and none is chosen.
    """
    path = Path(path)
    options = read_options(path, **how)
    records = assemble_all(
        *_open_records(path, options, start),
        options,
        record_id=record_id,
        control=control,
        role=role,
        noise=noise,
        start=start,
    )
    if len(records) > 1:
        raise several_specimens(path, len(records))
    return records[0]


def assemble_all(
    source: Source,
    profile: Profile,
    reading: Reading,
    options: ReadOptions,
    *,
    record_id: str | None = None,
    control: str = "other",
    role: str = "identify",
    noise: Noise | None = None,
    start: str = "auto",
) -> tuple[Record, ...]:
    """Turn the specimens asked for into records, named after the file unless named."""
    stem = record_id or _stem(source.path)
    film = None if options.strain_from is None else read_film(source.path, options.strain_from)
    several = record_id is None and len(reading.tables) > 1
    return tuple(
        assemble(
            source,
            profile.name,
            reading,
            table,
            options,
            record_id=f"{stem}-{number}" if several else stem,
            control=control,
            role=role,
            noise=noise,
            start=start,
            film=film,
        )
        for number, table in chosen_tables(source.path, reading, options.specimen_index)
    )


def _stem(path: Path) -> str:
    """The file's name without endings."""
    return path.name.split(".")[0] or path.name
