"""From the files of a laboratory to a campaign: read, recognise, ask what is not in them, write."""

import os
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from os import PathLike
from pathlib import Path
from typing import Any, ClassVar, Unpack, cast

from probation._complaint import quoted, suggestion
from probation._files import check_folder_place, kind_of, make_folder, read_whole, write_whole
from probation.errors import InputError
from probation.progress import shows_progress
from probation.records.assignment import assign_columns
from probation.records.campaign import Campaign
from probation.records.campaign_file import FILE_NAME
from probation.records.initial.control import guess_control
from probation.records.initial.questions import Question, answered, next_question, refuse_unanswered, unanswerable
from probation.records.initial.text import Entry, campaign_text
from probation.records.opening import chosen_tables, open_file
from probation.records.options import SPECIMEN_KEYS, ReadingKeys, read_options
from probation.records.reading import assemble_all
from probation.records.record import CONTROLS, RECORD_ROLES, Record
from probation.results.data import Stored
from probation.results.rendering import Result

Ask = Callable[[Question], str]
PAGE_NAME = "records.html"


@dataclass(frozen=True, eq=False)
class InitialCampaign(Result, Stored):
    """A campaign that was made of files.

    `plot` draws every record, `report` writes them as a page. In JSON the records are whole, as the summary draws them,
    too.

    Attributes
    ----------
    campaign : Campaign
        As `Campaign.load` reads it from its folder.
    reads : dict of str to str
        By record: file, profile, and which column is which.
    """

    SCHEMA: ClassVar[str] = "probation.initial-campaign/1"

    campaign: Campaign
    folder: Path
    reads: dict[str, str]

    def to_dict(self) -> dict[str, Any]:
        """What was written, as Python objects."""
        return {
            "folder": str(self.folder),
            "campaign": self.campaign.name,
            "records": [{**record.to_dict(), "read": self.reads[record.id]} for record in self.campaign.records],
        }


@shows_progress
def init_campaign(
    files: Sequence[str | PathLike[str]],
    folder: str | PathLike[str],
    *,
    name: str | None = None,
    control: str | None = None,
    role: str | None = None,
    link: bool = False,
    by_file: Mapping[str, Mapping[str, Any]] | None = None,
    ask: Ask | None = None,
    progress: Callable[[int, int, str], None] | None = None,
    **how: Unpack[ReadingKeys],
) -> InitialCampaign:
    """Make a campaign of the files of a laboratory: a folder with campaign.toml, the files, and a page of plots.

    Parameters
    ----------
    files : sequence of path-like
        What `preview` reads; each specimen of each becomes a record.
    folder : path-like
        Made if need be; must not hold a campaign.
    name : str, optional
        Of the campaign; by default the folder's.
    control : {"strain-rate", "displacement-rate", "hold", "cyclic", "other"}, optional
        How the tests were driven; by default guessed of each strain.
    role : {"identify", "held-out"}, optional
        By default "identify".
    link : bool
        Name the files where they are instead of copying them: the campaign then does not survive moving.
    by_file : mapping of str to mapping, optional
        ``control``, ``role`` and the keywords of `preview` for single files, by their names; they win over the others.
    ask : callable, optional
        Called with a `Question` for what is not in a file, returns the answer, or an empty text for the default.
        Without it, defaults are taken.
    progress : callable, optional
        Called with how many files are read, of how many, and the name of the next.
    **how
        How the files are read, as in `preview`: ``profile``, ``columns``, ``units``, ``specimen``,
        ``specimen_index``, ``sheet``, ``test_rate``. Of several files ``specimen`` is for those that state no
        dimensions; of one, and by ``by_file``, it wins over what the file states.

    Returns
    -------
    InitialCampaign

    Raises
    ------
    InputError
        If a file cannot be read, holds a stress or a strain of zeros, or if files do not say what has no default and
        cannot be asked: the error names every option that is missing.
    """
    check_folder_place(folder)
    folder = Path(folder)
    if kind_of(folder / FILE_NAME) is not None:
        raise InputError(f"{folder}: found a {FILE_NAME}, expected a new folder; name another, or remove the file")
    if not files:
        raise InputError("found no files, expected at least one")
    paths = [Path(file) for file in files]
    for path in paths:
        if any("\ud800" <= character <= "\udfff" for character in path.name):
            raise InputError(f"{path}: found a name that is not UTF-8, which no {FILE_NAME} can hold; rename the file")
    single = _by_file(paths, by_file or {})
    target = _Target(folder, link)
    read: list[tuple[Path, ReadingKeys, dict[str, str | None]]] = []
    for path in paths:
        own = dict(single.get(path.name, {}))
        choices = {"control": own.pop("control", control), "role": own.pop("role", role)}
        said = how if len(paths) == 1 else _where_not_stated(path, how, own)
        read.append((path, _merged(said, own), choices))
    if ask is None:
        refuse_unanswered([question for path, merged, _ in read for question in unanswerable(path, merged)])
    entries: list[Entry] = []
    for count, (path, merged, choices) in enumerate(read):
        if progress:
            progress(count, len(read), f"reading {path.name}")
        entries += _entries(path, merged, choices, target, ask)
    if progress:
        progress(len(read), len(read), "drawing the records")
    entries = _with_unique_ids(entries)
    if all(entry.record.role != "identify" for entry in entries):
        raise InputError('found held-out records only, expected at least one with the role "identify"')
    make_folder(folder)
    target.write()
    write_whole(folder / FILE_NAME, campaign_text(name or folder.resolve().name or "campaign", entries))
    made = InitialCampaign(
        Campaign.load(folder),
        folder,
        {entry.record.id: f"{entry.file}: {entry.read}" for entry in entries},
    )
    try:
        made.report(folder / PAGE_NAME)
    except OSError:
        (folder / FILE_NAME).unlink()  # so that the same call can be made again
        raise
    return made


class _Target:
    """The names that files get in the folder, each once, and their copies."""

    def __init__(self, folder: Path, link: bool) -> None:
        self._folder = folder
        self._link = link
        self._sources: dict[str, Path] = {}

    def name(self, path: Path) -> str:
        """What campaign.toml calls a file."""
        named = next((name for name, source in self._sources.items() if source == path), None)
        if named is not None:
            return named
        within = os.path.relpath(os.path.realpath(path), os.path.realpath(self._folder))
        if self._link or not within.startswith(".."):
            return Path(within).as_posix()
        stem, ending = path.name.partition(".")[0] or "record", "".join(path.suffixes)
        name, number = path.name, 2
        taken = {FILE_NAME, PAGE_NAME, *(name.casefold() for name in self._sources)}
        while name.casefold() in taken or not self._is_free(name, path):
            name, number = f"{stem}-{number}{ending}", number + 1
        self._sources[name] = path
        return name

    def _is_free(self, name: str, path: Path) -> bool:
        """Whether nothing has that name in the folder, or the same bytes: an attempt before left them there."""
        kind = kind_of(self._folder / name)
        return kind is None or (kind == "a file" and read_whole(self._folder / name) == read_whole(path))

    def write(self) -> None:
        """Copy the files, byte for byte."""
        for name, path in self._sources.items():
            write_whole(self._folder / name, read_whole(path))


def _by_file(paths: Sequence[Path], given: Mapping[str, Mapping[str, Any]]) -> dict[str, Mapping[str, Any]]:
    names = [path.name for path in paths]
    by_name: dict[str, Mapping[str, Any]] = {}
    for name, keys in given.items():
        if Path(name).name not in names:
            raise InputError(
                f"found something said of {quoted(name)}, which is not among the files; "
                + suggestion(Path(name).name, names)
            )
        by_name[Path(name).name] = {**by_name.get(Path(name).name, {}), **keys}
    return by_name


def _where_not_stated(path: Path, how: ReadingKeys, own: Mapping[str, Any]) -> ReadingKeys:
    """What is said of all files, without the dimensions of the specimen that this one states."""
    options = read_options(path, **_merged({key: value for key, value in how.items() if key != "specimen"}, own))
    stated = open_file(path, options)[2].tables[0].specimen
    section = {key for key in SPECIMEN_KEYS if key != "gauge_length_mm"}
    known = (section if "area_mm2" in stated else set()) | ({"gauge_length_mm"} & set(stated))
    specimen = {key: value for key, value in (how.get("specimen") or {}).items() if key not in known}
    return cast("ReadingKeys", {**how, "specimen": specimen})


def _merged(how: Mapping[str, Any], own: Mapping[str, Any]) -> ReadingKeys:
    """What is said of all files and of this one; dictionaries key by key."""
    both = dict(how)
    for key, value in own.items():
        both[key] = {**(both.get(key) or {}), **value} if isinstance(value, Mapping) else value
    if own.get("test_rate") is None and "time" in (both.get("columns") or {}):
        both["test_rate"] = None
    return cast("ReadingKeys", both)


def _entries(
    path: Path, how: ReadingKeys, choices: Mapping[str, str | None], target: "_Target", ask: Ask | None
) -> list[Entry]:
    file, film = target.name(path), how.get("strain_from")
    if film is not None:
        film = {**film, "file": target.name(path.parent / str(film.get("file", "")))}
    while (question := next_question(path, how)) is not None:
        how = answered(path, how, question, _answer(question, ask))
    options = read_options(path, **how)
    source, profile, reading = open_file(path, options)
    sheets: Sequence[str | None] = reading.like_sheets if len(reading.like_sheets) > 1 else (options.sheet,)
    entries = []
    for sheet in sheets:
        chosen = replace(options, sheet=sheet)
        source, profile, reading = open_file(path, chosen)
        records = assemble_all(source, profile, reading, chosen)
        tables = chosen_tables(path, reading, chosen.specimen_index)
        for record, (number, table) in zip(records, tables, strict=True):
            _check_moves(path, record)
            columns = assign_columns(table, chosen)
            read = ", ".join(f"{role} {quoted(column.label)}" for role, column in columns.items())
            keys = {
                "columns": chosen.columns,
                "units": chosen.units,
                "specimen": how.get("specimen"),
                "sheet": sheet,
                "specimen_index": number if len(reading.tables) > 1 else None,
                "test_rate": chosen.test_rate,
                "strain_from": None if film is None else {key: value for key, value in film.items() if value},
                "profile": options.profile,
            }
            named = replace(record, id=f"{record.id}-{sheet}") if len(sheets) > 1 else record
            entries.append(
                Entry(
                    _driven(named, choices, ask),
                    file,
                    {key: value for key, value in keys.items() if value},
                    f"by profile {profile.name}: {read}",
                    table.specimen,
                )
            )
    return entries


def _check_moves(path: Path, record: Record) -> None:
    """Refuse a record in which nothing happens."""
    for quantity, values in (("stress", record.true_stress), ("strain", record.true_strain)):
        if not values.any():
            raise InputError(
                f"{path}: {record.id}: found a {quantity} of zero in all {len(record)} samples, expected a test; "
                "name the column that holds it (--column), or leave the file out"
            )


def _driven(record: Record, choices: Mapping[str, str | None], ask: Ask | None) -> Record:
    """The record with its control and role, as said, guessed, or asked: the control only where no guess is made."""

    def chosen(key: str, known: tuple[str, ...], text: str, default: str) -> str:
        answer = choices[key] or _answer(Question(record.id, key, text, f"--{key} …", default, known), ask)
        if answer not in known:
            raise InputError(f"{key}: found {quoted(answer)}; {suggestion(answer, known)}")
        return answer

    control = choices["control"] or guess_control(record)
    if control == "other" or control not in CONTROLS:
        control = chosen("control", CONTROLS, "way the test was driven", "other")
    role = chosen("role", RECORD_ROLES, "role: identify on it, or hold it out and only predict it", "identify")
    return replace(record, control=control, role=role)


def _answer(question: Question, ask: Ask | None) -> str:
    answer = (ask(question) if ask is not None else "") or question.default
    if not answer:
        raise question.unanswered()
    return answer


def _with_unique_ids(entries: Sequence[Entry]) -> list[Entry]:
    unique: list[Entry] = []
    taken: set[str] = set()
    for entry in entries:
        name, number = entry.record.id, 2
        while name in taken:
            name, number = f"{entry.record.id}-{number}", number + 1
        taken.add(name)
        unique.append(replace(entry, record=replace(entry.record, id=name)))
    return unique
