"""campaign.toml to settings and records; everything wrong in it is named by its row."""

import hashlib
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from probation._complaint import bad_input, quoted, suggestion
from probation._files import kind_of, read_whole
from probation.errors import InputError
from probation.law.calibration_settings import CALIBRATION_KEYS, CalibrationSettings
from probation.law.settings import COMPANION_FORMS, FIXABLE, CompanionSettings, LawSettings
from probation.limits import TOML_BYTES
from probation.records.encoding import decode
from probation.records.film import KEYS as STRAIN_FROM_KEYS
from probation.records.options import SPECIMEN_KEYS
from probation.records.profiles import PROFILES
from probation.records.reading import read_record
from probation.records.record import CONTROLS, RECORD_ROLES, Noise, Record
from probation.records.roles import ROLES
from probation.records.specimens import DEVIATIONS, SPECIMENS_KEYS, WAYS, Specimens
from probation.records.start import STARTS
from probation.records.temperatures import with_temperature
from probation.records.toml_table import TomlTable

FILE_NAME = "campaign.toml"
_RECORD_KEYS = (
    "id",
    "file",
    "control",
    "role",
    "columns",
    "units",
    "profile",
    "specimen",
    "specimen_id",
    "specimen_index",
    "sheet",
    "test_rate",
    "strain_from",
    "noise",
    "start",
    "temperature_file",
    "temperature_C",
)


@dataclass(frozen=True)
class CampaignFile:
    """What a campaign.toml says, its records read."""

    name: str
    path: Path
    sha256: str
    law: LawSettings
    specimens: Specimens
    records: tuple[Record, ...]


def load_campaign_file(path: Path) -> CampaignFile:
    """Read a campaign.toml and every record that it names.

    Parameters
    ----------
    path : Path
        The file, or the folder it stands in.

    Raises
    ------
    InputError
        At the first thing that is wrong in the campaign or in one of its files.
    """
    path = _campaign_path(path)
    data = read_whole(path, TOML_BYTES)
    top = TomlTable.load(path, decode(path, data)[0])
    top.only(("name", "law", "specimens", "record"))
    law = _law(top.table("law"))
    specimens = _specimens(top.table("specimens"))
    entries = list(top.tables("record"))
    if not entries:
        raise bad_input(path, "no records", "at least one", remedy="add a [[record]] with id and file")
    _check_ids(entries)
    records = tuple(_record(path.parent, entry) for entry in entries)
    if not any(record.role == "identify" for record in records):
        raise bad_input(path, "held-out records only", 'at least one record with role = "identify"')
    return CampaignFile(
        name=top.text("name", default=path.resolve().parent.name or "campaign"),
        path=path,
        sha256=hashlib.sha256(data).hexdigest(),
        law=law,
        specimens=specimens,
        records=records,
    )


def _campaign_path(path: Path) -> Path:
    what = kind_of(path)
    if what == "a folder":
        if kind_of(path / FILE_NAME) is None:
            raise bad_input(path, f"no {FILE_NAME}", "a campaign folder", remedy=f"write {FILE_NAME} into it")
        return path / FILE_NAME
    if what is None:
        raise InputError(f"{path}: found no such file or folder; expected a campaign folder or its {FILE_NAME}")
    return path


def _law(table: TomlTable) -> LawSettings:
    table.only(("modes", "decades", "accuracy", "companion", "fixed"))
    fixed = table.table("fixed")
    fixed.only(FIXABLE)
    try:
        return LawSettings(
            modes=table.whole_number("modes", 50),
            decades=table.number("decades", 6.0),
            accuracy=table.number("accuracy") if "accuracy" in table.values else None,
            companion=_companion(table.table("companion")) if "companion" in table.values else None,
            fixed={name: fixed.number(name) for name in fixed.values},
        )
    except InputError as failure:
        raise _at_path(table.path, failure) from None


def _specimens(table: TomlTable) -> Specimens:
    table.only(SPECIMENS_KEYS)
    if not isinstance(table.values.get("scatter"), dict):
        return Specimens(table.text("scatter", default="estimate", known=WAYS))
    scatter = table.table("scatter")
    scatter.only(DEVIATIONS)
    values = {name: scatter.number(name) for name in scatter.values}
    for name, value in values.items():
        try:
            Specimens({name: value})
        except InputError as failure:
            expected = str(failure).partition(", expected ")[2]
            raise scatter.complain(name, f"{name} = {value}", expected) from None
    return Specimens(values)


def _companion(table: TomlTable) -> CompanionSettings:
    form = table.text("form", known=COMPANION_FORMS)
    names = COMPANION_FORMS[form]
    table.only(("form", *names, *CALIBRATION_KEYS))
    read = table.numbers if form == "table" else table.number
    parameters = {name: read(name) for name in names}
    return CompanionSettings(form=form, parameters=parameters, calibration=_calibration(table))


def _calibration(table: TomlTable) -> CalibrationSettings | None:
    if not set(CALIBRATION_KEYS) & set(table.values):
        return None
    rates = None
    if "calibrated_rates_per_s" in table.values:
        numbers = table.numbers("calibrated_rates_per_s")
        if len(numbers) != 2:
            raise table.complain(
                "calibrated_rates_per_s", f"{len(numbers)} calibrated_rates_per_s", "two, slowest first"
            )
        rates = (numbers[0], numbers[1])
    return CalibrationSettings(
        rates=rates,
        covariance=table.rows_of_numbers("covariance") if "covariance" in table.values else None,
        log_scatter=table.number("log_scatter", 0.0),
        unrelaxed_modulus_MPa=table.number("unrelaxed_modulus_MPa")
        if "unrelaxed_modulus_MPa" in table.values
        else None,
    )


def _check_ids(entries: list[TomlTable]) -> None:
    seen: dict[str, str] = {}
    for entry in entries:
        record_id = entry.text("id")
        if record_id in seen:
            raise entry.complain(
                "id",
                f"the id {quoted(record_id)} again",
                "unique ids",
                f"{seen[record_id]} has it; rename one",
            )
        seen[record_id] = entry.name


def _record(folder: Path, entry: TomlTable) -> Record:
    entry.only(_RECORD_KEYS)
    columns, units = entry.table("columns"), entry.table("units")
    specimen, noise = entry.table("specimen"), entry.table("noise")
    columns.only(ROLES)
    units.only(ROLES)
    specimen.only(SPECIMEN_KEYS)
    noise.only(("stress_MPa", "strain"))
    levels = {name: noise.number(name) for name in noise.values}
    for name, level in levels.items():
        try:
            Noise(**{name: level})
        except InputError as failure:
            expected = str(failure).partition(", expected ")[2]
            raise noise.complain(name, f"{name} = {level}", expected) from None
    profiles = [profile.name for profile in PROFILES]
    index = entry.whole_number("specimen_index") if "specimen_index" in entry.values else None
    record = read_record(
        _existing(folder, entry, "file"),
        profile=entry.text("profile", known=profiles) if "profile" in entry.values else None,
        columns={role: _label(columns, role) for role in columns.values},
        units={role: units.text(role) for role in units.values},
        specimen={key: specimen.number(key) for key in specimen.values},
        specimen_index=index,
        sheet=entry.text("sheet") if "sheet" in entry.values else None,
        test_rate=entry.text("test_rate") if "test_rate" in entry.values else None,
        strain_from=_strain_from(folder, entry) if "strain_from" in entry.values else None,
        record_id=entry.text("id"),
        control=entry.text("control", default="other", known=CONTROLS),
        role=entry.text("role", default="identify", known=RECORD_ROLES),
        noise=Noise(stress_MPa=levels.get("stress_MPa"), strain=levels.get("strain")),
        start=entry.text("start", default="auto", known=STARTS),
    )
    if "specimen_id" in entry.values:
        record = replace(record, specimen_id=entry.text("specimen_id"))
    if "temperature_file" in entry.values:
        return with_temperature(record, _existing(folder, entry, "temperature_file"), index or 1)
    if "temperature_C" not in entry.values:
        return record
    if record.temperature is not None:
        raise entry.complain(
            "temperature_C", "it together with a column of temperatures", "one of the two", "leave it out"
        )
    return replace(record, temperature=np.full(len(record), entry.number("temperature_C")))


def _strain_from(folder: Path, entry: TomlTable) -> dict[str, object]:
    """What the record says of its strain file, relative to the campaign's folder as `file` is."""
    given = entry.table("strain_from")
    given.only(STRAIN_FROM_KEYS)
    columns, units, specimen = given.table("columns"), given.table("units"), given.table("specimen")
    columns.only(ROLES)
    units.only(ROLES)
    specimen.only(SPECIMEN_KEYS)
    said: dict[str, object] = {
        "file": str(_existing(folder, given, "file").absolute()),
        "columns": {role: _label(columns, role) for role in columns.values},
        "units": {role: units.text(role) for role in units.values},
        "specimen": {key: specimen.number(key) for key in specimen.values},
    }
    for key, read in (
        ("shift_s", given.number),
        ("specimen_index", given.whole_number),
        ("sheet", given.text),
        ("profile", given.text),
    ):
        if key in given.values:
            said[key] = read(key)
    return said


def _label(columns: TomlTable, role: str) -> str | int:
    """Read a heading, or a position counted from 1."""
    if isinstance(columns.values[role], int):
        return columns.whole_number(role)
    return columns.text(role)


def _existing(folder: Path, entry: TomlTable, key: str) -> Path:
    name = entry.text(key)
    path = folder / name
    if kind_of(path) is None:
        folder = path.parent
        beside = sorted(p.name for p in folder.iterdir() if p.is_file()) if kind_of(folder) == "a folder" else []
        beside = [other for other in beside if other != FILE_NAME]
        remedy = suggestion(name, beside) if beside else f"{folder} holds no file"
        raise entry.complain(key, f"{key} = {quoted(name)}", "a file that exists", remedy)
    return path


def _at_path(path: Path, failure: InputError) -> InputError:
    """Put the file's name before a complaint that does not know it."""
    message = str(failure)
    return failure if message.startswith(str(path)) else InputError(f"{path}: {message}")
